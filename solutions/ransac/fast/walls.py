"""Walls from a laser scan by RANSAC, one line after the other."""

import numpy as np

from solutions.lines.line_fitting import Line, fit_line, positions_along
from solutions.lines.scan import Segment, Settings, is_wall, make_segment, scan_points
from solutions.ransac.fast.consensus import ransac_line


def sequential_ransac(
    ranges: np.ndarray,
    angles: np.ndarray,
    rng: np.random.Generator,
    settings: Settings | None = None,
    iterations: int = 200,
    max_gap: float = 1.0,
) -> list[Segment]:
    """Return the walls in one scan of (N,) ranges in metres and angles in radians, largest first.

    Find the line that most points agree with, cut its inliers where neighbours along the line
    are more than `max_gap` metres apart, keep the longest part as a segment, take its points
    away, and look again until too few points are left or agree. Unlike split-and-merge it
    does not use the order of the beams, so it finds a wall behind a person in one piece, and
    sometimes sees one where points of different things line up.
    """
    settings = settings or Settings()
    points, beams = scan_points(ranges, angles, settings)
    left = np.arange(len(points))
    segments = []
    while len(left) >= settings.min_points:
        found = ransac_line(points[left], 2 * settings.roughness, iterations, rng)
        if found is None or len(found.inliers) < settings.min_points:
            break
        part = left[_longest_part(points[left], found.model, found.inliers, max_gap)]
        if len(part) >= settings.min_points:
            line = fit_line(points[part])
            if is_wall(points[part], line, settings):
                segments.append(make_segment(points[part], beams[part], line, settings))
        left = np.setdiff1d(left, part)
    return segments


def _longest_part(
    points: np.ndarray, line: Line, inliers: np.ndarray, max_gap: float
) -> np.ndarray:
    """Return, ascending, those inliers that follow each other along the line without a gap."""
    along = positions_along(points[inliers], line)
    order = np.argsort(along)
    parts = np.split(inliers[order], np.flatnonzero(np.diff(along[order]) > max_gap) + 1)
    return np.sort(max(parts, key=len))
