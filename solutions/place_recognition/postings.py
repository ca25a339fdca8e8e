"""The inverted file of some images in flat arrays: a part of a larger one.

`inverted_file.build_inverted_file` makes the same lists, one Python list a word.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

MOST_IMAGES = 2**16  # in one part, so that two bytes hold an image's number


class Postings(NamedTuple):
    """Which of M images have which word, and how often, sorted by word and image.

    The list of `words[i]` is at `starts[i]` to `starts[i + 1]` of `images` and `counts`.
    """

    image_count: int
    words: np.ndarray  # (W,) the different words, in rising order
    starts: np.ndarray  # (W + 1,)
    images: np.ndarray  # (P,) uint16, from 0 to image_count - 1
    counts: np.ndarray  # (P,) the smallest unsigned integers that hold them, at least 1

    @property
    def lengths(self) -> np.ndarray:
        """How many images have each of the words."""
        return np.diff(self.starts)

    def lists_of(self, words: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Look words up: return the images of all lists, end to end, the counts, and the lengths.

        The lengths are (len(words),); a word that no image has gets an empty list.
        """
        at = np.searchsorted(self.words, words)
        found = at < len(self.words)
        found[found] = self.words[at[found]] == words[found]
        starts, ends = np.zeros((2, len(words)), dtype=np.intp)
        starts[found], ends[found] = self.starts[at[found]], self.starts[at[found] + 1]
        lists = [slice(*ends_of_list) for ends_of_list in zip(starts, ends, strict=True)]
        images = [self.images[part] for part in lists] or [self.images[:0]]
        counts = [self.counts[part] for part in lists] or [self.counts[:0]]
        return np.concatenate(images), np.concatenate(counts), ends - starts


def postings_of(words_by_image: Sequence[np.ndarray]) -> Postings:
    """Return the inverted file of images, given the words of the features of each."""
    lengths = [len(words) for words in words_by_image]
    image = np.repeat(np.arange(len(lengths)), lengths)
    word = np.concatenate([np.asarray(words, dtype=np.int64) for words in words_by_image])
    # One number for word and image, which sorts by word first.
    occurrences = np.sort(word * MOST_IMAGES + image)
    first = np.flatnonzero(np.diff(occurrences, prepend=-1))
    pairs = occurrences[first]
    counts = np.diff(first, append=len(occurrences))
    return _with_lists(len(lengths), pairs // MOST_IMAGES, pairs % MOST_IMAGES, counts)


def merged(one: Postings, other: Postings) -> Postings:
    """Return the inverted file of both; the images of `other` come after those of `one`."""
    word = np.concatenate([np.repeat(part.words, part.lengths) for part in (one, other)])
    order = np.argsort(word, kind="stable")
    images = np.concatenate([one.images, other.images + np.uint16(one.image_count)])
    counts = np.concatenate([one.counts, other.counts])
    image_count = one.image_count + other.image_count
    return _with_lists(image_count, word[order], images[order], counts[order])


def _with_lists(
    image_count: int, word: np.ndarray, images: np.ndarray, counts: np.ndarray
) -> Postings:
    first = np.flatnonzero(np.diff(word, prepend=-1))
    return Postings(
        image_count,
        word[first].astype(np.int32),
        np.append(first, len(word)),
        images.astype(np.uint16),
        counts.astype(np.min_scalar_type(counts.max(initial=0))),
    )
