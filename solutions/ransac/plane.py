"""RANSAC for a plane as the course explains it: one hypothesis after the other.

`solutions.ransac.fast.consensus.ransac_plane` is the same algorithm with all hypotheses in one
matrix product.
"""

import numpy as np

from solutions.lines.plane_fitting import Plane, fit_plane, plane_distances


def ransac_plane(
    points: np.ndarray, threshold: float, iterations: int, rng: np.random.Generator
) -> tuple[Plane, np.ndarray]:
    """Return the plane that most points agree with, and the indices of these points.

    `points` is an (N, 3) array in metres. Each of the `iterations` samples holds three
    different points, drawn with `rng`; a point agrees with their plane if it is at most
    `threshold` metres away, on either side. The plane of the largest consensus set is fitted
    again, with `fit_plane`, to all points of that set. The indices, in any order, are those of
    the points within the threshold of this last plane; they may be those of the consensus set
    as well, which is nearly always the same.

    Raises:
        ValueError: if no sample gave a plane, as when all points are on one line or `iterations`
            is 0.
    """
    if not isinstance(rng, np.random.Generator):
        raise TypeError(f"Samples are drawn with a np.random.Generator, not with {rng!r}.")
    if np.ma.is_masked(points):  # the mask would be dropped without a word
        raise TypeError("Some points are masked; leave them out first.")
    best = np.array([], dtype=int)
    for _ in range(iterations):
        a, b, c = points[rng.choice(len(points), size=3, replace=False)]
        normal = np.cross(b - a, c - a)
        length = np.linalg.norm(normal)
        if length == 0:  # the three points are on one line, and so on many planes
            continue
        agreeing = np.flatnonzero(np.abs((points - a) @ normal) <= threshold * length)
        if len(agreeing) > len(best):
            best = agreeing
    if len(best) == 0:
        raise ValueError("No plane: the points of each sample were on one line.")
    plane = fit_plane(points[best])
    return plane, np.flatnonzero(np.abs(plane_distances(points, plane)) <= threshold)
