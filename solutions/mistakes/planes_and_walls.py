"""What students write for `ransac_plane` and `find_walls`, and what goes wrong."""

import numpy as np

from solutions.lines.plane_fitting import Plane, fit_plane, plane_distances
from solutions.ransac.line import ransac_line


def _ransac_plane(points, threshold, iterations, rng, agrees, refit=True):
    best, best_plane = np.array([], dtype=int), Plane((0.0, 0.0, 1.0), 0.0)
    for _ in range(iterations):
        a, b, c = points[rng.choice(len(points), size=3, replace=False)]
        normal = np.cross(b - a, c - a)
        length = np.linalg.norm(normal)
        if length == 0:
            continue
        agreeing = np.flatnonzero(agrees((points - a) @ normal, length))
        if len(agreeing) > len(best):
            unit = normal / length * (1.0 if a @ normal >= 0 else -1.0)
            best, best_plane = agreeing, Plane(tuple(unit), float(a @ unit))
    if refit:
        best_plane = fit_plane(points[best])
    return best_plane, np.flatnonzero(np.abs(plane_distances(points, best_plane)) <= threshold)


def forgets_to_normalise(points, threshold, iterations, rng):
    """Uses the cross product as if it had length 1: large triangles get too narrow a band."""
    return _ransac_plane(points, threshold, iterations, rng, lambda d, _: np.abs(d) <= threshold)


def keeps_the_sample_plane(points, threshold, iterations, rng):
    """Returns the plane through the three sampled points, without a fit to all that agree."""
    return _ransac_plane(
        points, threshold, iterations, rng, lambda d, n: np.abs(d) <= threshold * n, refit=False
    )


def counts_one_side(points, threshold, iterations, rng):
    """Forgets the absolute value: everything behind the plane agrees as well."""
    return _ransac_plane(points, threshold, iterations, rng, lambda d, n: d <= threshold * n)


def fits_all_points(points, threshold, iterations, rng):
    """Least squares over everything, outliers too."""
    plane = fit_plane(points)
    return plane, np.flatnonzero(np.abs(plane_distances(points, plane)) <= threshold)


def counts_among_the_rest(points, threshold, iterations, min_points, rng):
    """Returns indices into the points that were left, not into all points."""
    walls, left = [], np.arange(len(points))
    while len(left) >= min_points:
        line, inliers = ransac_line(points[left], threshold, iterations, rng)
        if len(inliers) < min_points:
            break
        walls.append((line, inliers))
        left = np.delete(left, inliers)
    return walls


def stops_after_one_wall(points, threshold, iterations, min_points, rng):
    """Finds the first wall only."""
    line, inliers = ransac_line(points, threshold, iterations, rng)
    return [(line, inliers)] if len(inliers) >= min_points else []


def keeps_small_walls(points, threshold, iterations, min_points, rng):
    """Keeps the last line too, although fewer than min_points points agree with it."""
    walls, left = [], np.arange(len(points))
    while len(left) >= min_points:
        line, inliers = ransac_line(points[left], threshold, iterations, rng)
        walls.append((line, left[inliers]))
        left = np.delete(left, inliers)
        if len(inliers) < min_points:
            break
    return walls


def leaves_the_points_in(points, threshold, iterations, min_points, rng):
    """Does not take the points of a wall away, and so finds the same wall again and again."""
    line, inliers = ransac_line(points, threshold, iterations, rng)
    return [(line, inliers)] * (len(points) // min_points)
