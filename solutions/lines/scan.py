"""A laser scan as points, and what line extraction starts from: unbroken runs of them."""

import math
from dataclasses import dataclass, fields
from typing import NamedTuple

import numpy as np

from solutions.lines.line_fitting import (
    Line,
    distances,
    line_covariance,
    point_at,
    positions_along,
)

# In standard deviations of the difference of two readings: noise makes no gap even among the
# thousands of neighbours in a scan with fine beams.
_NOISE = 5 * math.sqrt(2)
_TURN = 2 * math.pi
# m; two points are equally far from a chord, however their distances were rounded: the first is
# the corner. Without noise, the beams on both sides of a corner are.
SAME_DISTANCE = 1e-9


@dataclass(frozen=True)
class Settings:
    """What counts as a wall.

    The defaults suit a SICK LMS scanner with centimetre noise; `solutions.lines.scanners` has
    settings for others.
    """

    sigma: float = 0.01  # m, standard deviation of a point
    split_distance: float = 0.06  # m, a point this far from the chord is a corner
    roughness: float = 0.02  # m, largest root mean square distance from a wall
    min_points: int = 8
    min_length: float = 0.6  # m
    min_radius: float = 15.0  # m, what bends more is a round thing
    # Neighbours that meet at an angle between these two are pieces of a round thing.
    straight_angle: float = math.radians(8.0)
    corner_angle: float = math.radians(30.0)
    max_range: float = 49.0  # m, at or beyond: no echo
    grazing_angle: float = math.radians(10.0)  # a wall seen at a smaller angle is broken up

    def __post_init__(self) -> None:
        if self.min_points < 2:
            raise ValueError(f"A wall needs two points: min_points={self.min_points} is too few.")
        for field in fields(self):
            if not getattr(self, field.name) >= 0:
                raise ValueError(f"The setting {field.name} must be a number, and not negative.")

    @property
    def min_neighbor_points(self) -> int:
        """How many points a piece needs to show that its neighbour is part of a round thing."""
        return max(2, self.min_points // 2)


class Segment(NamedTuple):
    """A piece of a wall."""

    line: Line
    start: np.ndarray  # (2,) m, the foot of the first inlier on the line
    end: np.ndarray  # (2,) m, the foot of the last inlier
    covariance: np.ndarray  # (2, 2), of (r, alpha)
    inliers: np.ndarray  # indices of the beams, ascending but for a wall across a full turn's ends


def is_echo(ranges: np.ndarray, settings: Settings) -> np.ndarray:
    """Return where `ranges` (metres, any shape) holds a distance: finite, positive, in range."""
    with np.errstate(invalid="ignore"):
        return (ranges > 0) & (ranges < settings.max_range)


def check_unit(ranges: np.ndarray, settings: Settings) -> None:
    """Check that `ranges` (any shape) can be metres: millimetres would leave no echo at all.

    Beams without an echo do not count: they have one reading, or few different ones.

    Raises:
        ValueError: if hardly a reading is within the range, and the many others are far beyond.
    """
    if not ranges.size or is_echo(ranges, settings).mean() > 0.05:
        return
    readings = ranges[np.isfinite(ranges) & (ranges > 0)]
    if len(np.unique(readings)) > 5 and np.median(readings) > 2 * settings.max_range:
        raise ValueError(
            f"Ranges are in metres, and none beyond max_range={settings.max_range:g} is an echo: "
            f"half of these readings are above {np.median(readings):g}. Divide millimetres by 1000."
        )


def as_ranges(ranges: np.ndarray) -> np.ndarray:
    """Return (N,) ranges as floats; a beam that is masked has no echo, which is NaN."""
    return np.where(np.ma.getmaskarray(ranges), np.nan, np.ma.getdata(ranges).astype(float))


def scan_points(
    ranges: np.ndarray, angles: np.ndarray, settings: Settings
) -> tuple[np.ndarray, np.ndarray]:
    """Return the echoes of one scan as (N, 2) points in metres, and the N beams they are from."""
    ranges, angles = as_ranges(ranges), np.asarray(angles, dtype=float)
    if ranges.ndim != 1 or ranges.shape != angles.shape:
        raise ValueError(
            f"One scan needs as many ranges as angles, not {ranges.shape} and {angles.shape}."
        )
    check_unit(ranges, settings)
    beams = np.flatnonzero(is_echo(ranges, settings))
    ranges, angles = ranges[beams], angles[beams]
    return np.column_stack([ranges * np.cos(angles), ranges * np.sin(angles)]), beams


def check_angles(angles: np.ndarray) -> None:
    """Check that (N,) beams turn to the left, at most once round.

    Gaps and corners are looked for in this order.

    Raises:
        ValueError: if they do not.
    """
    if not (np.isfinite(angles).all() and (np.diff(angles) > 0).all()):
        raise ValueError("The angles must grow from beam to beam: turn ranges and angles round.")
    if len(angles) and angles[-1] - angles[0] > _TURN + 1e-6:
        raise ValueError(
            "The beams turn more than once round: angles are in radians (np.radians), and a scan "
            "ends after a full turn."
        )


def is_full_turn(angles: np.ndarray) -> bool:
    """Tell whether the first of (N,) beams follows the last: the scanner turns right round."""
    if len(angles) < 3:
        return False
    return bool(_TURN - (angles[-1] - angles[0]) < 1.5 * np.median(np.diff(angles)))


def first_beams(ranges: np.ndarray, angles: np.ndarray, settings: Settings) -> np.ndarray:
    """Return (M,) the beam with which each of (M, B) scans begins, so that no wall is cut in two.

    A scan of less than a full turn begins with beam 0. A full turn has no seam: it begins behind
    its widest gap, or, where it has none, at its farthest point, which is a corner.
    """
    echo = is_echo(ranges, settings)
    if not is_full_turn(angles):
        return np.zeros(len(ranges), dtype=np.intp)
    seen = np.where(echo, ranges, 0.0)
    first = seen.argmax(axis=1)
    for scan in np.flatnonzero(echo.any(axis=1)):
        beams = np.flatnonzero(echo[scan])
        beams = np.append(beams, beams[0])  # once round
        turn = np.append(angles[beams[:-1]], angles[beams[0]] + _TURN)
        points = seen[scan, beams, None] * np.column_stack([np.cos(turn), np.sin(turn)])
        gaps = np.flatnonzero(breaks(points, seen[scan, beams], turn, settings))
        if len(gaps):
            widest = gaps[np.hypot(*np.diff(points, axis=0)[gaps].T).argmax()]
            first[scan] = beams[widest + 1]
    return first


def breaks(
    points: np.ndarray, ranges: np.ndarray, angles: np.ndarray, settings: Settings
) -> np.ndarray:
    """Return (N - 1,): whether there is a gap between each two neighbours of (N, 2) points.

    The gap that is still allowed grows with the range: it is what a wall shows that the beam
    meets at the grazing angle (Borges and Aldon, Line Extraction in 2D Range Images for
    Mobile Robotics, 2004).
    """
    step = np.diff(angles)
    nearer = np.minimum(ranges[:-1], ranges[1:])
    beyond = np.maximum(np.sin(settings.grazing_angle - step), 1e-9)
    allowed = nearer * np.sin(step) / beyond + _NOISE * settings.sigma
    gap = np.hypot(*np.diff(points, axis=0).T)
    return (gap > allowed) | (step >= settings.grazing_angle)


def is_wall(points: np.ndarray, line: Line, settings: Settings) -> bool:
    """Tell whether (N, 2) ordered points with their line are many, long and straight enough."""
    start, end = positions_along(points[[0, -1]], line)
    distance = distances(points, line)
    quarter = len(points) // 4
    middle = distance[quarter : len(points) - quarter].mean()
    return bool(
        len(points) >= settings.min_points
        and abs(end - start) >= settings.min_length
        and math.sqrt(np.mean(distance**2)) <= settings.roughness
        and not is_curved(len(points), abs(end - start), middle, settings)
    )


def is_curved(
    N: np.ndarray | int,
    length: np.ndarray | float,
    middle: np.ndarray | float,
    settings: Settings,
) -> np.ndarray | bool:
    """Tell whether N points along `length` metres bend too much for a wall: numbers, or (n,) each.

    `middle` is the mean distance of the middle half of the points from the line. With
    the outer half on the other side it is a quarter of an arc's height, length² / 8 radius.
    A bend that noise may have made does not count.
    """
    height = 4 * np.abs(middle)
    by_chance = 3 * 4 * settings.sigma / np.sqrt(N)
    return (height > by_chance) & (8 * height * settings.min_radius > length**2)


def is_bend(
    alpha: np.ndarray | float, next_alpha: np.ndarray | float, settings: Settings
) -> np.ndarray | bool:
    """Tell whether neighbouring lines meet at too small an angle for a corner of two walls.

    Both angles are in radians, numbers or arrays (n,); the result is of that kind.
    """
    turn = np.abs(np.remainder(next_alpha - alpha + math.pi / 2, math.pi) - math.pi / 2)
    return (turn > settings.straight_angle) & (turn < settings.corner_angle)


def make_segment(points: np.ndarray, beams: np.ndarray, line: Line, settings: Settings) -> Segment:
    """Return the segment of a line between the feet of its first and last of (N, 2) points."""
    start, end = point_at(positions_along(points[[0, -1]], line), line)
    return Segment(line, start, end, line_covariance(points, settings.sigma), beams)
