"""Clouds in which every right RANSAC finds the same consensus set, whatever it draws.

Along a wall (or over a plane) lie points with little noise. In the middle of it lie a few inliers
just inside the threshold, on both sides, and a few outliers just beyond it: a line that bends to
take one of these outliers in loses more inliers on the other side. So exactly one consensus set is
the largest, nearly every pair of points that are far apart finds it, and a band that is too wide
or too narrow finds another one. All other outliers keep so far away that no line along the wall
reaches them, even with a band of several thresholds.
"""

import math
from typing import NamedTuple

import numpy as np


class Noise(NamedTuple):
    """Where the points lie across the wall, in thresholds."""

    bulk: float  # most points: at this distance, on either side
    inside: tuple[float, float]  # the inliers in the middle
    beyond: tuple[tuple[float, float], ...]  # the outliers in the middle


# What a refit changes, and what a band changes that is a tenth too wide or too narrow, is seen.
STRICT = Noise(0.03, (0.94, 0.96), ((1.1, 1.12), (1.4, 1.6), (3.0, 4.0)))
# A line through two points, without a refit, finds the same points.
LENIENT = Noise(0.05, (0.65, 0.7), ((1.4, 1.5), (3.0, 4.0)))

# So many outliers that few samples are free of them: each that is finds the same points.
EXACT = Noise(0.0, (0.65, 0.7), ((1.4, 1.5), (3.0, 4.0)))

INSIDE = 3  # inliers in the middle, on each side
FAR = 21.0  # thresholds between the wall and the other outliers, at least


def across_the_wall(
    rng: np.random.Generator, threshold: float, count: int, noise: Noise = STRICT, sides: int = 2
) -> tuple[np.ndarray, np.ndarray]:
    """Return offsets from the wall of the `count` points along it, and of those in its middle.

    Of the latter the first 2 * INSIDE are inliers. The others lie on one side of the wall or on
    two: on two they would hardly move a line that is fitted to them as well.
    """
    signs = rng.choice([-1.0, 1.0], count)
    bulk = signs * noise.bulk * rng.uniform(0.7, 1.0, count)
    middle = [side * rng.uniform(*noise.inside) for _ in range(INSIDE) for side in (-1, 1)]
    middle += [side * rng.uniform(*ends) for ends in noise.beyond for side in (-1, 1)[:sides]]
    return bulk * threshold, np.array(middle) * threshold


def far_away(
    rng: np.random.Generator, threshold: float, farthest: float, count: int, sides: int = 2
) -> np.ndarray:
    """Return offsets of outliers from the wall, on one side of it or on two."""
    away = rng.uniform(FAR * threshold, farthest, count)
    return away if sides == 1 else away * rng.choice([-1.0, 1.0], count)


def axes_of(alpha: float) -> np.ndarray:
    """Return the normal of a line and the direction along it as the rows of a (2, 2) array."""
    normal = [math.cos(alpha), math.sin(alpha)]
    return np.array([normal, [-normal[1], normal[0]]])


def outliers_first(rng: np.random.Generator, inliers: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Return the rows of both, each shuffled: who looks at the first ones sees no wall."""
    return np.vstack([rng.permutation(others), rng.permutation(inliers)])


def evenly_mixed(inliers: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Return the rows of both, so that among any few neighbours there is one of each.

    Whoever samples neighbours, in place of any points, then finds nothing.
    """
    places = [np.linspace(0, 1, len(part)) for part in (others, inliers)]
    return np.vstack([others, inliers])[np.argsort(np.concatenate(places), kind="stable")]
