"""All walls of a scan as the course explains it: find one, take its points away, look again.

`solutions.ransac.fast.walls` does the same and also cuts a line where it has gaps.
"""

import numpy as np

from solutions.lines.line_fitting import Line
from solutions.ransac.line import ransac_line


def find_walls(
    points: np.ndarray,
    threshold: float,
    iterations: int,
    min_points: int,
    rng: np.random.Generator,
) -> list[tuple[Line, np.ndarray]]:
    """Return all walls among the points, those that were found first in front.

    `points` is an (N, 2) array in metres; `threshold`, `iterations` and `rng` are those of
    `ransac_line`. A wall is a pair of its line and the indices of its points, counted in
    `points`; each point belongs to at most one wall. The search ends when a line has
    fewer than `min_points` points, or when fewer than `min_points` points are left.
    """
    walls = []
    left = np.arange(len(points))  # the points that belong to no wall yet
    while len(left) >= max(min_points, 2):
        try:
            line, inliers = ransac_line(points[left], threshold, iterations, rng)
        except ValueError:  # no line among them, as when they are all in one spot
            break
        if len(inliers) < min_points:
            break
        walls.append((line, left[inliers]))
        left = np.delete(left, inliers)
    return walls
