"""What split-and-merge promises at its limits, one scan at a time and many at once."""

from __future__ import annotations

import math

import numpy as np
import pytest

from solutions.lines.line_extraction import (
    Segment,
    Settings,
    split,
    split_and_merge,
    split_and_merge_all,
)
from solutions.lines.line_fitting import distances, fit_line, positions_along
from solutions.lines.scan import scan_points

ANGLES = np.radians(np.arange(-90.0, 90.0))
ROUND = np.radians(np.arange(360.0))


def one_by_one(
    ranges: np.ndarray, angles: np.ndarray, settings: Settings | None = None
) -> list[Segment]:
    return split_and_merge(ranges, angles, settings)


def all_at_once(
    ranges: np.ndarray, angles: np.ndarray, settings: Settings | None = None
) -> list[Segment]:
    """The scan is the second of three, of which the others see nothing."""
    nothing = np.full_like(ranges, np.inf)
    found = split_and_merge_all(np.stack([nothing, ranges, nothing]), angles, settings)
    assert found.of(0) == found.of(2) == []
    return found.of(1)


METHODS = pytest.mark.parametrize("extract", [one_by_one, all_at_once])


def seen(angles: np.ndarray, *walls: tuple[float, float]) -> np.ndarray:
    """Ranges in a room whose walls are lines (r, alpha), alpha in degrees."""
    with np.errstate(divide="ignore"):
        ranges = [r / np.cos(angles - math.radians(alpha)) for r, alpha in walls]
    return np.min([np.where(one > 0, one, np.inf) for one in ranges], axis=0)


def inliers(segments: list[Segment]) -> list[list[int]]:
    return [segment.inliers.tolist() for segment in segments]


def test_a_point_exactly_at_the_distance_is_no_corner():
    points = np.array([[0.0, 0.0], [1.0, 1.0], [2.0, 0.0]])
    assert split(points, 1.0) == [(0, 2)]
    assert split(points, 0.999) == [(0, 1), (2, 2)]


def test_points_in_one_spot_are_one_piece():
    assert split(np.ones((4, 2)), 0.1) == [(0, 3)]


def test_two_points_are_not_split_even_where_no_distance_is_allowed():
    for points in np.random.default_rng(0).normal(size=(500, 2, 2)):
        assert split(points, 0.0) == [(0, 1)]


def test_a_scan_may_be_lists_and_masked_readings_are_no_echoes():
    ranges = seen(ANGLES, (4.0, 0.0), (3.0, 90.0), (2.0, -90.0))
    expected = split_and_merge(ranges, ANGLES)
    assert inliers(split_and_merge(ranges.tolist(), ANGLES.tolist())) == inliers(expected)
    assert len(expected) == 3
    without = ranges.copy()
    without[80:85] = np.nan
    masked = np.ma.masked_array(ranges, np.isnan(without))
    assert inliers(split_and_merge(masked, ANGLES)) == inliers(split_and_merge(without, ANGLES))


@METHODS
@pytest.mark.parametrize("turned", [0, 1, 40, 135, 174, 175, 180, 186, 187, 359])
def test_a_full_turn_has_no_seam_wherever_it_begins(extract, turned):
    """A wall in which the beams of more than the grazing angle are lost is two, also at the seam.

    The widest gap is behind a single echo that belongs to the wall but for such a gap.
    """
    ranges = np.roll(seen(ROUND, (2.0, 0.0)), 180)  # ahead is beam 180
    ranges[:136] = ranges[225:] = np.inf
    ranges[175:187] = np.nan
    ranges[137:149] = np.nan
    ranges[250:330] = np.roll(seen(ROUND, (9.0, 0.0)), 290)[250:330]
    segments = extract(np.roll(ranges, turned), ROUND)
    expected = [range(149, 175), range(187, 225), range(250, 330)]
    assert sorted(inliers(segments)) == sorted(
        [(beam + turned) % 360 for beam in beams] for beams in expected
    )


@METHODS
def test_the_corners_of_a_square_are_not_joined(extract):
    """Every line fits them as well; in pairs they are two sides."""
    angles = np.radians([-135.0, -45.0, 45.0, 135.0])
    settings = Settings(sigma=1.0, min_points=2, grazing_angle=math.radians(170.0))
    segments = extract(np.ones(4), angles, settings)
    assert sorted(len(beams) for beams in inliers(segments)) == [2, 2]


@METHODS
@pytest.mark.parametrize("count", [0, 1])
@pytest.mark.parametrize("side", [1, -1])
def test_two_neighbors_that_bend_are_no_walls_and_a_third_may_be(extract, count, side):
    bent = [(3.0, side * -10.0), (3.0, side * 10.0)]
    third = [(2.0, side * 80.0)][:count]
    ranges = seen(ANGLES, *bent, *third)
    ranges[np.abs(ANGLES) > math.radians(60.0)] = np.inf
    found = [segment.line for segment in extract(ranges, ANGLES)]
    assert len(found) == count
    for line, (r, alpha) in zip(found, third, strict=True):
        assert line == pytest.approx((r, math.radians(alpha)), abs=0.01)


def test_a_piece_of_exactly_half_a_walls_length_shows_a_bend():
    ranges = seen(ANGLES, (3.0, 0.0), (2.9, 20.0))
    ranges[:84] = ranges[130:] = np.inf
    no_bends = Settings(min_length=0.0, corner_angle=0.0)
    short, long = split_and_merge(ranges, ANGLES, no_bends)
    points, beams = scan_points(ranges, ANGLES, no_bends)
    piece = points[np.isin(beams, short.inliers)]
    start, end = positions_along(piece[[0, -1]], fit_line(piece))
    assert 2 * abs(end - start) < math.dist(long.start, long.end)

    at_the_limit = Settings(min_length=2 * abs(end - start))
    assert split_and_merge(ranges, ANGLES, at_the_limit) == []
    for extract in (one_by_one, all_at_once):
        shorter = Settings(min_length=1.999 * abs(end - start))
        assert extract(ranges, ANGLES, shorter) == []
        longer = Settings(min_length=2.001 * abs(end - start))
        assert inliers(extract(ranges, ANGLES, longer)) == inliers([long])


@METHODS
def test_two_pieces_that_are_exactly_as_rough_as_a_wall_may_be_are_one(extract):
    """To 0.1 mm; a wall itself is measured exactly, so the limit is one that was rounded up."""
    for distance in np.linspace(3.0, 3.1, 20):
        ranges = seen(ANGLES, (distance, -6.0), (distance, 6.0))
        ranges[:60] = ranges[121:] = np.inf
        points, beams = scan_points(ranges, ANGLES, Settings())
        exact = math.sqrt(np.mean(distances(points, fit_line(points)) ** 2))
        if exact < round(exact, 4) - 1e-6:
            break
    for less, count in ((0.0, 1), (0.0001, 2)):
        settings = Settings(
            sigma=1.0, grazing_angle=0.1, corner_angle=0.0, roughness=round(exact, 4) - less
        )
        found = extract(ranges, ANGLES, settings)
        assert len(found) == count
        assert sorted(beam for one in inliers(found) for beam in one) == beams.tolist()


@METHODS
@pytest.mark.parametrize(
    ("side", "count", "walls"), [(1, 3, [12]), (1, 4, []), (-1, 2, [11]), (-1, 3, [])]
)
def test_a_piece_of_less_than_half_a_walls_points_shows_no_bend(extract, side, count, walls):
    """A wall of 12 points, and a piece of few that goes on at 20 degrees and is long enough.

    The piece that comes first has the point at the corner as well.
    """
    angles = np.radians(np.arange(12.0 + count) - 11.5)  # the walls meet at 0
    ranges = 10 / np.cos(angles)
    turned = math.radians(-20.0)
    behind = angles > 0
    ranges[behind] = 10 * math.cos(turned) / np.cos(angles[behind] - turned)
    if side < 0:
        ranges, angles = ranges[::-1], -angles[::-1]
    found = extract(ranges, angles, Settings(min_length=0.6))
    assert [len(beams) for beams in inliers(found)] == walls


@METHODS
def test_the_walls_of_a_closet_are_as_near_as_they_are(extract):
    walls = [(0.5, 0.0), (0.4, 90.0), (0.3, 180.0), (0.45, -90.0)]
    found = extract(seen(ROUND, *walls), ROUND, Settings(min_length=0.3))
    assert len(found) == 4
    for r, alpha in walls:
        away = [
            abs(one.line.r - r) + abs(np.exp(1j * one.line.alpha) - np.exp(1j * np.radians(alpha)))
            for one in found
        ]
        assert min(away) < 0.03


@METHODS
def test_two_points_of_a_wall_at_45_degrees_are_one_if_that_is_enough(extract):
    """As wide as high, to the last digit in many of these; their direction is clear."""
    settings = Settings(min_points=2, grazing_angle=1.0)
    for half in np.linspace(0.2, 0.4, 30):
        angles = np.array([math.pi / 4 - half, math.pi / 4 + half])
        (segment,) = extract(np.array([2.0, 2.0]), angles, settings)
        assert segment.line == pytest.approx((2 * math.cos(half), math.pi / 4))


@METHODS
def test_the_normal_of_a_wall_behind_is_pi_and_not_the_same_below(extract):
    settings = Settings(min_points=2, grazing_angle=1.0)
    for half in np.linspace(0.2, 0.4, 30):
        angles = np.array([math.pi - half, math.pi + half])
        (segment,) = extract(np.array([2.0, 2.0]), angles, settings)
        assert -math.pi < segment.line.alpha <= math.pi
        assert math.cos(segment.line.alpha) == pytest.approx(-1.0)


@pytest.mark.parametrize(
    ("ranges", "angles"),
    [((3, 179), (180,)), ((180,), (180,)), ((2, 3, 180), (180,)), ((2, 3, 4), (3, 4)), ((5,), ())],
)
def test_many_scans_have_as_many_ranges_as_angles_each(ranges, angles):
    with pytest.raises(ValueError, match=r"Needs \(M, B\) ranges and \(B,\) angles, not"):
        split_and_merge_all(np.ones(ranges), np.zeros(angles))


def test_many_scans_may_be_lists_and_masked_readings_are_no_echoes():
    scans = np.tile(seen(ANGLES, (4.0, 0.0), (3.0, 90.0), (2.0, -90.0)), (2, 1))
    without = scans.copy()
    without[1, 80:85] = np.nan
    masked = np.ma.masked_array(scans, np.isnan(without))
    expected = split_and_merge_all(without, ANGLES)
    for given in (without.tolist(), masked):
        found = split_and_merge_all(given, ANGLES.tolist())
        for scan in (0, 1):
            assert inliers(found.of(scan)) == inliers(expected.of(scan))
            assert len(found.of(scan)) == 3
