"""A database of images of places, to be asked where a new photograph was taken."""

import json
from pathlib import Path
from typing import Literal, NamedTuple, Self

import numpy as np

from solutions.place_recognition.fast.index import InvertedIndex
from solutions.place_recognition.fast.storage import read_arrays, write_arrays
from solutions.place_recognition.fast.vocabulary_tree import VocabularyTree


class Candidate(NamedTuple):
    """An image that may show the place of the query."""

    name: str
    score: float  # votes, the more the better; or an L1 distance from 0 to 2, the less the better


class ImageDatabase:
    """Model images and their visual words; images can be added at any time.

    The tree has to be fitted, and stays as it is.
    """

    def __init__(self, tree: VocabularyTree):
        self.tree = tree
        self.names: list[str] = []
        self._known: set[str] = set()
        self._index = InvertedIndex(tree.word_count)

    def __len__(self) -> int:
        return len(self.names)

    def add(self, name: str, descriptors: np.ndarray | None) -> None:
        """Add a model image: link each of its words to it.

        An image without descriptors (None, as OpenCV gives) is added, and never a candidate.

        Raises:
            ValueError: if there is an image of this name already.
        """
        if name in self._known:
            raise ValueError(f"There is an image named {name!r} already: choose another name.")
        self._index.extend([self.tree.words(descriptors)])
        self.names.append(name)
        self._known.add(name)

    def query(
        self,
        descriptors: np.ndarray | None,
        top: int = 5,
        scoring: Literal["tf-idf", "votes"] = "tf-idf",
    ) -> list[Candidate]:
        """Return at most `top` candidates, the best first; of equal ones the one added first.

        `scoring` is either "votes", the voting array of the course, or "tf-idf", the L1 distance
        of weighted histograms. An image that shares no word (with tf-idf: no word of any weight)
        is no candidate, so the list may be shorter, or empty.
        """
        if not isinstance(top, int | np.integer) or top < 1:
            raise ValueError(f"Ask for a whole number of candidates, 1 or more, not for top={top}.")
        words = self.tree.words(descriptors)
        if scoring == "votes":
            votes = self._index.votes(words)
            return self._best(-votes, votes, votes > 0, top)
        if scoring == "tf-idf":
            scores = self._index.scores(words)
            return self._best(scores, scores, scores < 2.0, top)
        raise ValueError(f'The scoring is "tf-idf" or "votes", not {scoring!r}.')

    def save(self, path: str | Path) -> None:
        """Write names and inverted file to an npz file, without pickle; the tree is saved apart."""
        names = np.frombuffer(json.dumps(self.names).encode(), dtype=np.uint8)
        tree = np.array(self.tree.fingerprint())
        write_arrays(path, names=names, tree=tree, **self._index.arrays())

    @classmethod
    def load(cls, path: str | Path, tree: VocabularyTree) -> Self:
        """Read what `save` wrote, for the same tree.

        Raises:
            ValueError: if the file holds something else, or belongs to another tree.
        """
        stored = read_arrays(path, "an image database", "names", "tree", "word_count")
        database = cls(tree)
        try:
            database._index = InvertedIndex.from_arrays(stored)
            database.names = [str(name) for name in json.loads(bytes(stored["names"]))]
        except (KeyError, ValueError, TypeError, IndexError) as error:
            raise ValueError(f"{path} is damaged: save the database again.") from error
        if len(database.names) != database._index.image_count:
            raise ValueError(f"{path} is damaged, it lacks names: save the database again.")
        if database._index.word_count != tree.word_count:
            raise ValueError(
                f"{path} was made with {database._index.word_count} words, the tree has "
                f"{tree.word_count}: load the tree that was saved with it."
            )
        if stored["tree"].tolist() != tree.fingerprint():
            raise ValueError(
                f"{path} was made with another tree of as many words: load the tree that was "
                "saved with it."
            )
        database._known = set(database.names)
        return database

    def _best(
        self, order: np.ndarray, scores: np.ndarray, eligible: np.ndarray, top: int
    ) -> list[Candidate]:
        """Return the eligible images with the smallest entries of `order`."""
        images = np.flatnonzero(eligible)
        if top < len(images):  # sort only what may be among the best
            limit = np.partition(order[images], top - 1)[top - 1]
            images = images[order[images] <= limit]
        best = images[np.argsort(order[images], kind="stable")][:top]
        return [Candidate(self.names[image], scores[image].item()) for image in best]
