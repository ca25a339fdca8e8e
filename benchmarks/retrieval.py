"""How well a vocabulary tells places apart: each campus photograph in turn is the query."""

from collections.abc import Callable

import numpy as np

import data
from solutions.place_recognition import InvertedIndex, extract_features

Words = Callable[[np.ndarray], np.ndarray]  # (N, d) descriptors to (N,) words


def campus_descriptors(kind: str = "sift") -> dict[str, np.ndarray]:
    """The (n, 128) or (n, 32) descriptors of all 25 photographs by number, in order."""
    photographs = {**data.campus_photographs(), **data.campus_queries()}
    return {
        name: extract_features(photographs[name], kind).descriptors  # type: ignore[arg-type]
        for name in sorted(photographs)
    }


def quality(
    descriptors: dict[str, np.ndarray], words: Words, word_count: int, votes: bool = False
) -> tuple[float, float]:
    """Mean average precision and recall at 1, leaving one photograph out at a time.

    `descriptors` holds an (n, d) array for each photograph. The other 24 are ranked, with tf-idf
    weights that know only them. A photograph counts as a query if geometry verified at least one
    other of the same place.
    """
    pairs = data.same_place_pairs()
    words_of = {name: words(own) for name, own in descriptors.items()}
    precisions, firsts = [], []
    for query, query_words in words_of.items():
        others = [name for name in words_of if name != query]
        relevant = np.array([frozenset((query, name)) in pairs for name in others])
        if not relevant.any():
            continue
        index = InvertedIndex(word_count)
        index.extend([words_of[name] for name in others])
        order = -index.votes(query_words) if votes else index.scores(query_words)
        ranked = relevant[np.argsort(order, kind="stable")]
        precisions.append(average_precision(ranked))
        firsts.append(bool(ranked[0]))
    return float(np.mean(precisions)), float(np.mean(firsts))


def average_precision(ranked: np.ndarray) -> float:
    """The mean, over the relevant ones, of the precision at their rank.

    `ranked` is an array (n,) that says of each rank whether it is relevant.
    """
    precision = np.cumsum(ranked) / np.arange(1, len(ranked) + 1)
    return float(precision[ranked].mean())
