"""Walls from a laser scan, by split-and-merge.

Split an unbroken run of points at the point farthest from its chord, until all points are
close to theirs; merge neighbours that are straight together; fit a line to what is left.
`solutions.lines.fast.scan_lines` does the same for many scans at once,
`solutions.ransac.fast.walls` looks for lines without using the order of the points.

Source: Nguyen, Martinelli, Tomatis and Siegwart, A Comparison of Line Extraction Algorithms
using 2D Laser Rangefinder for Indoor Mobile Robotics, IROS 2005.
"""

import math
from itertools import pairwise

import numpy as np

from solutions.lines.fast.scan_lines import ScanSegments, split_and_merge_all
from solutions.lines.line_fitting import Line, distances, fit_line, positions_along
from solutions.lines.scan import (
    SAME_DISTANCE,
    Segment,
    Settings,
    as_ranges,
    breaks,
    check_angles,
    first_beams,
    is_bend,
    is_wall,
    make_segment,
    scan_points,
)
from solutions.ransac.fast.walls import sequential_ransac

__all__ = [
    "ScanSegments",
    "Segment",
    "Settings",
    "sequential_ransac",
    "split",
    "split_and_merge",
    "split_and_merge_all",
]


def split_and_merge(
    ranges: np.ndarray, angles: np.ndarray, settings: Settings | None = None
) -> list[Segment]:
    """Return the walls in one scan, in the order of the beams.

    A scan of a full turn has no seam: a wall across its ends is one wall.

    `ranges` in metres and `angles` in radians (ascending) belong to the same N beams. Beams
    without an echo (not finite, not positive, at the maximum range) are left out. Raises
    ValueError for arrays of other shapes, or angles that do not ascend.
    """
    settings = settings or Settings()
    points, beams = scan_points(ranges, angles, settings)
    check_angles(angles)
    ranges, angles = as_ranges(ranges), np.asarray(angles, dtype=float)
    first = first_beams(ranges[None], angles, settings)[0]
    order = np.argsort((beams - first) % max(1, len(ranges)))
    points, beams = points[order], beams[order]
    turned = np.where(beams < first, angles[beams] + 2 * math.pi, angles[beams])
    gaps = breaks(points, ranges[beams], turned, settings)
    segments = []
    for run in np.split(np.arange(len(points)), np.flatnonzero(gaps) + 1):
        corners = split(points[run], settings.split_distance)
        pieces = [run[first : last + 1] for first, last in corners]
        pieces = _merge(points, pieces, settings.roughness)
        for piece, line in _walls(points, pieces, settings):
            segments.append(make_segment(points[piece], beams[piece], line, settings))
    return segments


def split(points: np.ndarray, distance: float) -> list[tuple[int, int]]:
    """Return the first and last index of each straight piece of an ordered run of points.

    The chord goes from the first of the (N, 2) points to the last. If the point farthest from
    it is more than `distance` metres away, the run is split behind that point, and both parts
    are treated in the same way.
    """
    first, last = 0, len(points) - 1
    if last < 2:
        return [(first, last)] if last >= 0 else []
    dx, dy = points[last] - points[first]
    length = max(math.hypot(dx, dy), 1e-12)
    offset = np.abs((points - points[first]) @ [-dy, dx]) / length
    corner = int((offset >= offset.max() - SAME_DISTANCE).argmax())
    if offset.max() <= distance:
        return [(first, last)]
    left = split(points[: corner + 1], distance)
    right = split(points[corner + 1 :], distance)
    return left + [(start + corner + 1, end + corner + 1) for start, end in right]


def _merge(points: np.ndarray, pieces: list[np.ndarray], roughness: float) -> list[np.ndarray]:
    """Join the two neighbours that are straightest together, until no two are straight enough."""
    pieces = list(pieces)
    while len(pieces) > 1:
        joined = [np.concatenate(pair) for pair in pairwise(pieces)]
        costs = [_roughness(points[both]) for both in joined]
        best = int(np.argmin(costs))
        if costs[best] > roughness:
            break
        pieces[best : best + 2] = [joined[best]]
    return pieces


def _roughness(points: np.ndarray) -> float:
    try:
        # To 0.1 mm, so that any two single points cost the same; the first pair then goes first.
        return round(math.sqrt(np.mean(distances(points, fit_line(points)) ** 2)), 4)
    except ValueError:  # a blob is not straight
        return math.inf


def _walls(
    points: np.ndarray, pieces: list[np.ndarray], settings: Settings
) -> list[tuple[np.ndarray, Line]]:
    """Return the pieces of one run that are walls, with their lines."""
    lines = []
    for piece in pieces:
        if len(piece) >= settings.min_neighbor_points:
            line = fit_line(points[piece])
            start, end = positions_along(points[piece[[0, -1]]], line)
            if abs(end - start) >= settings.min_length / 2:
                lines.append((piece, line))
    round_things = set()
    for i, ((_, line), (_, next_line)) in enumerate(pairwise(lines)):
        if is_bend(line.alpha, next_line.alpha, settings):
            round_things |= {i, i + 1}
    return [
        (piece, line)
        for i, (piece, line) in enumerate(lines)
        if i not in round_things and is_wall(points[piece], line, settings)
    ]
