"""What an explorer computes, once more in Python: for its still picture, with the same numbers."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

Point = tuple[float, float]


class Run(NamedTuple):
    """What a run of RANSAC has come to: the best sample, its inliers, and the samples asked for."""

    pair: tuple[int, int]  # indices of the two points of the best sample
    inliers: np.ndarray  # shape (M,), indices of the points in its band
    asked: list[int]  # after each sample, how many the best share of inliers so far asks for


def random_numbers(seed: int) -> Iterator[float]:
    """Yield numbers from 0 to 1, the same as `randomNumbers` in plot.js."""
    state = seed
    while True:
        state = (state * 1664525 + 1013904223) % 2**32
        yield state / 2**32


def ransac_run(points: np.ndarray, threshold: float, iterations: int, seed: int) -> Run:
    """Draw samples of two points, as the explorer `ransac_steps.js` does.

    Args:
        points: shape (N, 2), metres, not all in one place.
        threshold: the half width of a line's band, in metres.
        iterations: how many samples to draw.
        seed: the run's number; the explorer's first run has number 1.
    """
    random = random_numbers(seed)
    pair, best, asked = (0, 0), np.empty(0, int), list[int]()
    for _ in range(iterations):
        i, j = _sample(points, random)
        dx, dy = points[j] - points[i]
        across = (points[:, 0] - points[i, 0]) * dy - (points[:, 1] - points[i, 1]) * dx
        inliers = np.flatnonzero(np.abs(across) <= threshold * math.sqrt(dx * dx + dy * dy))
        if not asked or len(inliers) > len(best):
            pair, best = (i, j), inliers
        asked.append(samples_asked_for(len(best) / len(points)))
    return Run(pair, best, asked)


def samples_asked_for(share: float, allowed: float = 0.05) -> int:
    """Count samples of two until the chance that all hold an outlier is small enough."""
    spoilt, count = 1.0, 0
    while spoilt > allowed and count < 1e7:
        spoilt -= spoilt * share * share
        count += 1
    return count


def consensus(points: np.ndarray, band: float) -> np.ndarray:
    """Return the indices, shape (M,), of the most points that agree with a line through two.

    As `consensus` in cloud.js: a point agrees that is at most `band` metres away from the line.
    """
    members = np.arange(len(points))[:0]
    for i in range(len(points)):
        for j in range(i):
            dx, dy = points[j] - points[i]
            across = (points[:, 0] - points[i, 0]) * dy - (points[:, 1] - points[i, 1]) * dx
            found = np.flatnonzero(np.abs(across) <= band * math.hypot(dx, dy))
            if (dx or dy) and len(found) > len(members):
                members = found
    return members


def _sample(points: np.ndarray, random: Iterator[float]) -> tuple[int, int]:
    while True:
        i, j = (math.floor(next(random) * len(points)) for _ in range(2))
        if (points[i] != points[j]).any():
            return i, j
