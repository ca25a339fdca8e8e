"""A wall, or a plane, whose points fill the band, beside a smooth one that has fewer points.

The band decides which of the two is found: one that is too narrow finds the smooth one. In the
other clouds it finds the same wall with fewer points, and whoever counts them once more, in the
right band of the last line, would have them all.
"""

import math

import numpy as np

from solutions.cases.case import Case, seed_of
from solutions.cases.consensus import axes_of

# Any sample of the points in the rough one that have no offset finds all its points.
ON_IT, IN_THE_BAND = 28, 10  # of the rough one
SMOOTH = 32
IN_PART_OF_THE_BAND = (0.55, 0.65)  # thresholds on either side, in the middle


def rough_and_smooth_wall(
    rng: np.random.Generator, sizes: tuple[float, float], scale: float
) -> Case:
    """Return a case: two walls side by side, six times the scale long."""
    threshold = float(rng.uniform(*sizes))
    offsets = _offsets(rng, threshold, scale)
    positions = [np.linspace(-3, 3, ON_IT), np.linspace(-3, 3, SMOOTH)]
    positions.insert(1, rng.uniform(-0.02, 0.02, IN_THE_BAND))
    points = np.column_stack([offsets, scale * np.concatenate(positions)])
    points = points @ axes_of(rng.uniform(-3.0, 3.0))
    return _case(rng, "a rough wall beside a smooth one", points, threshold, 2, 100)


def rough_and_smooth_plane(
    rng: np.random.Generator, sizes: tuple[float, float], scale: float
) -> Case:
    """Return a case: two squares side by side, four times the scale wide."""
    threshold = float(rng.uniform(*sizes))
    offsets = _offsets(rng, threshold, scale)
    wide = np.full(len(offsets), 2.0)
    wide[ON_IT : ON_IT + IN_THE_BAND] = 0.02
    in_plane = scale * wide[:, None] * rng.uniform(-1, 1, (len(offsets), 2))
    axes = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    points = np.column_stack([offsets, in_plane]) @ axes
    return _case(rng, "a rough plane beside a smooth one", points, threshold, 3, 280)


def _offsets(rng: np.random.Generator, threshold: float, scale: float) -> np.ndarray:
    """Return how far the points lie from the origin, across both: the rough one's come first."""
    r = rng.uniform(2.0, 3.0) * scale
    sides = np.resize([-1.0, 1.0], IN_THE_BAND)
    band = sides * rng.uniform(*IN_PART_OF_THE_BAND, IN_THE_BAND) * threshold
    return np.concatenate([np.full(ON_IT, r), r + band, np.full(SMOOTH, r + 1.5 * scale)])


def _case(
    rng: np.random.Generator,
    name: str,
    points: np.ndarray,
    threshold: float,
    size: int,
    iterations: int,
) -> Case:
    return {
        "name": name,
        "args": [rng.permutation(points), threshold, iterations, seed_of(rng)],
        "draws": (iterations, math.inf),
        "samples": (size, iterations, iterations),
    }
