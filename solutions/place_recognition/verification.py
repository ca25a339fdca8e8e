"""Geometric verification: do the candidates show the same place, or only similar words?

Words say nothing about where things are. Here the features of two images are matched one by
one, and the matches have to agree with one fundamental matrix.
"""

from collections.abc import Iterable, Mapping
from typing import NamedTuple

import numpy as np

from solutions.place_recognition.features import Features, are_bits
from solutions.place_recognition.fundamental_matrix import ransac_fundamental


class Verified(NamedTuple):
    """A candidate and the number of matches that agree with one two-view geometry."""

    name: str
    inliers: int


def match_features(one: Features, other: Features, ratio: float = 0.8) -> np.ndarray:
    """Return (M, 2) indices: a feature of `one` and its match in `other`.

    A match is the nearest descriptor, if the second nearest is clearly farther (by the `ratio`
    of distances: Lowe, Distinctive image features from scale-invariant keypoints, IJCV 2004),
    and if it is the nearest in both directions. Near means the Euclidean distance, for bits the
    square root of how many differ.
    """
    if len(one.descriptors) < 2 or len(other.descriptors) < 2:
        return np.zeros((0, 2), dtype=np.intp)
    a, b = _as_points(one.descriptors), _as_points(other.descriptors)
    squared = (a**2).sum(axis=1)[:, None] - 2.0 * (a @ b.T) + (b**2).sum(axis=1)
    nearest = squared.argmin(axis=1)
    two_nearest = np.partition(squared, 1, axis=1)[:, :2]
    distinct = two_nearest[:, 0] < ratio**2 * two_nearest[:, 1]
    mutual = squared.argmin(axis=0)[nearest] == np.arange(len(a))
    kept = np.flatnonzero(distinct & mutual)
    return np.column_stack([kept, nearest[kept]])


def verify_candidates(
    query: Features,
    candidates: Iterable[str],
    features: Mapping[str, Features],
    rng: np.random.Generator,
    fewest: int = 20,
) -> list[Verified]:
    """Return the candidates with at least `fewest` inliers, the most certain first.

    `candidates` are names, for instance of `ImageDatabase.query`, and `features` are those of
    the images they name. Several matches between the same two spots count as one. On the campus
    photographs, chance reaches 18 inliers and most pairs of one place have 20 or more.
    """
    verified = []
    for name in candidates:
        matches = match_features(query, features[name])
        x, y = query.positions[matches[:, 0]], features[name].positions[matches[:, 1]]
        kept = one_of_each_place(x, y)
        geometry = ransac_fundamental(x[kept], y[kept], rng)
        inliers = 0 if geometry is None else len(geometry.inliers)
        if inliers >= fewest:
            verified.append(Verified(name, inliers))
    return sorted(verified, key=lambda candidate: -candidate.inliers)


def one_of_each_place(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return, ascending, the first match of each pair of places, to the nearest pixel.

    Both arrays are (M, 2), in pixels. SIFT describes a corner once for each direction that its
    gradients have, up to four times in one spot: their matches are one piece of evidence.
    """
    pixels = np.rint(np.hstack([x, y]))
    return np.sort(np.unique(pixels, axis=0, return_index=True)[1])


def _as_points(descriptors: np.ndarray) -> np.ndarray:
    if np.ma.is_masked(descriptors):  # the mask would be dropped without a word
        raise ValueError("Some descriptors are masked: leave these features out.")
    if are_bits(descriptors):
        descriptors = np.unpackbits(descriptors, axis=1)
    return descriptors.astype(np.float32)
