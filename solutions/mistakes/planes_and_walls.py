"""What students write for `ransac_plane` and `find_walls`, and what goes wrong."""

import math

import numpy as np

from solutions.lines.line_fitting import distances
from solutions.lines.plane_fitting import Plane, fit_plane, plane_distances
from solutions.ransac.line import ransac_line
from solutions.ransac.plane import ransac_plane
from solutions.ransac.walls import find_walls


def _ransac_plane(points, threshold, iterations, rng, agrees=None):
    """The plane of the best sample and its consensus set, with a part to replace by a wrong one."""
    agrees = agrees or (lambda d, length: np.abs(d) <= threshold * length)
    best, best_plane = np.array([], dtype=int), None
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
    if best_plane is None:
        raise ValueError("no plane")
    return best_plane, best


def _refitted(points, best, band):
    plane = fit_plane(points[best])
    return plane, np.flatnonzero(np.abs(plane_distances(points, plane)) <= band)


def forgets_to_normalise(points, threshold, iterations, rng):
    """Uses the cross product as if it had length 1: large triangles get too narrow a band."""
    _, best = _ransac_plane(points, threshold, iterations, rng, lambda d, _: np.abs(d) <= threshold)
    return _refitted(points, best, threshold)


def keeps_the_sample_plane(points, threshold, iterations, rng):
    """Returns the plane through the three sampled points, without a fit to all that agree."""
    return _ransac_plane(points, threshold, iterations, rng)


def counts_one_side(points, threshold, iterations, rng):
    """Forgets the absolute value: everything behind the plane agrees as well."""
    _, best = _ransac_plane(points, threshold, iterations, rng, lambda d, n: d <= threshold * n)
    return _refitted(points, best, threshold)


def fits_all_points(points, threshold, iterations, rng):
    """Least squares over everything, outliers too."""
    plane = fit_plane(points)
    return plane, np.flatnonzero(np.abs(plane_distances(points, plane)) <= threshold)


def _other_band(points, threshold, iterations, rng):
    _, best = _ransac_plane(points, threshold, iterations, rng)
    return _refitted(points, best, threshold)


def compares_the_square(points, threshold, iterations, rng):
    """Compares the squared distance with the threshold: the band has the width of its root."""
    return _other_band(points, math.sqrt(threshold), iterations, rng)


def halves_the_band(points, threshold, iterations, rng):
    """Takes the threshold for the width of the whole band."""
    return _other_band(points, threshold / 2, iterations, rng)


def fixes_the_threshold(points, threshold, iterations, rng):
    """Writes the 0.05 of an example in place of the argument."""
    return _other_band(points, 0.05, iterations, rng)


def fixes_both_numbers(points, threshold, iterations, rng):
    """Writes numbers in place of both arguments."""
    return _other_band(points, 0.05, 400, rng)


def fixes_few_iterations(points, threshold, iterations, rng):
    """Draws 30 samples, whatever was asked for."""
    return ransac_plane(points, threshold, 30, rng)


def fixes_many_iterations(points, threshold, iterations, rng):
    """Draws 400 samples, whatever was asked for."""
    return ransac_plane(points, threshold, 400, rng)


def makes_its_own_generator(points, threshold, iterations, rng):
    """Leaves the generator that it was given alone."""
    return ransac_plane(points, threshold, iterations, np.random.default_rng(0))


def returns_something_without_a_plane(points, threshold, iterations, rng):
    """Raises nothing where no sample gave a plane."""
    try:
        return ransac_plane(points, threshold, iterations, rng)
    except ValueError:
        return None, np.array([], dtype=int)


def takes_any_plane_through_a_line(points, threshold, iterations, rng):
    """Makes a plane even from three points on one line."""
    if iterations and np.linalg.matrix_rank(points - points[0]) < 2:
        return Plane((0.0, 0.0, 1.0), 0.0), np.arange(len(points))
    return ransac_plane(points, threshold, iterations, rng)


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


def wants_more_than_min_points(points, threshold, iterations, min_points, rng):
    """Drops a wall that has exactly min_points points."""
    return find_walls(points, threshold, iterations, min_points + 1, rng)


def fixes_min_points(points, threshold, iterations, min_points, rng):
    """Writes 20 in place of the argument."""
    return find_walls(points, threshold, iterations, 20, rng)


def shares_points_between_walls(points, threshold, iterations, min_points, rng):
    """Counts again in all points: a point where two lines cross belongs to both walls."""
    walls = find_walls(points, threshold, iterations, min_points, rng)
    return [
        (line, np.flatnonzero(np.abs(distances(points, line)) <= threshold)) for line, _ in walls
    ]


def fixes_the_wall_threshold(points, threshold, iterations, min_points, rng):
    """Calls ransac_line with a threshold of its own."""
    return find_walls(points, 0.05, iterations, min_points, rng)


def draws_few_samples_for_walls(points, threshold, iterations, min_points, rng):
    """Calls ransac_line with a small number of iterations of its own."""
    return find_walls(points, threshold, 40, min_points, rng)


def draws_many_samples_for_walls(points, threshold, iterations, min_points, rng):
    """Calls ransac_line with a large number of iterations of its own."""
    return find_walls(points, threshold, 400, min_points, rng)
