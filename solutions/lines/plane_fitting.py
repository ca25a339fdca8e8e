"""The plane that is closest to a set of points: the line fit, one dimension up."""

import math
from typing import NamedTuple

import numpy as np


class Plane(NamedTuple):
    """A plane normal . p = r."""

    normal: tuple[float, float, float]  # unit vector from the origin towards the plane
    r: float  # m, distance from the origin, never negative


def fit_plane(points: np.ndarray) -> Plane:
    """Return the plane with the least sum of squared distances to the (N, 3) points in metres.

    Raises:
        ValueError: if the points do not determine a plane: fewer than three, all on one line, or
            a cloud that is as thin in one direction as in another.
    """
    if np.ma.is_masked(points):  # the mask would be dropped without a word
        raise ValueError("No plane: some points are masked; leave them out first.")
    points = np.asarray(points, dtype=float)
    if points.ndim != 2 or points.shape[1] != 3 or len(points) < 3:
        raise ValueError(f"A plane needs an (N, 3) array of 3 points or more, not {points.shape}.")
    N = len(points)
    center = points.sum(axis=0) / N
    if not np.isfinite(center).all():
        raise ValueError("No plane: some coordinates are not finite; remove those points.")
    centered = points - center
    spread, directions = np.linalg.eigh(centered.T @ centered)  # ascending
    size = math.sqrt(spread[2] / N)
    rounding = 2e-15 * (size + math.hypot(*center))  # of the coordinates, in float64
    if not spread[1] - spread[0] > N * size * rounding:
        raise ValueError("No plane: the points are on one line, or equally thin in two directions.")
    normal = directions[:, 0]  # the direction in which the points vary least
    r = float(normal @ center)
    if r < 0:
        normal, r = -normal, -r
    return Plane(tuple(normal.tolist()), r)


def plane_distances(points: np.ndarray, plane: Plane) -> np.ndarray:
    """Return signed distances (N,) of (N, 3) points in metres, positive where the normal points."""
    return points @ plane.normal - plane.r
