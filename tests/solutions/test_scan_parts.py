"""The parts of line extraction one by one, at their limits; the numbers are by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest

from solutions.lines.line_fitting import Line
from solutions.lines.scan import (
    Settings,
    breaks,
    check_angles,
    first_beams,
    is_bend,
    is_curved,
    is_echo,
    is_full_turn,
    is_wall,
    scan_points,
)

TURN = 2 * math.pi
USUAL = Settings()
FIELDS = [name for name in Settings.__dataclass_fields__ if name != "min_points"]


@pytest.mark.parametrize("name", FIELDS)
@pytest.mark.parametrize("value", [-1e-9, math.nan])
def test_each_setting_is_a_number_and_not_negative(name, value):
    with pytest.raises(ValueError, match=f"The setting {name} must be a number, and not negative"):
        Settings(**{name: value})
    assert getattr(Settings(**{name: 0.0}), name) == 0


def test_a_wall_has_two_points_at_least():
    assert Settings(min_points=2).min_points == 2
    with pytest.raises(ValueError, match="min_points=1 is too few"):
        Settings(min_points=1)


@pytest.mark.parametrize(("least", "fewest"), [(2, 2), (4, 2), (5, 2), (6, 3), (7, 3), (8, 4)])
def test_a_neighbor_needs_half_of_a_walls_points_and_two(least, fewest):
    assert Settings(min_points=least).min_neighbor_points == fewest


def test_an_echo_is_a_distance_between_nothing_and_the_maximum_range():
    ranges = np.array([-1.0, 0.0, 1e-9, 0.5, 48.9, 49.0, 50.0, np.inf, -np.inf, np.nan])
    assert is_echo(ranges, USUAL).tolist() == [False, False, True, True, True] + [False] * 5


def test_the_points_of_a_scan_are_those_of_its_echoes():
    ranges, angles = [2.0, 0.0, 3.0, np.inf], [0.0, 0.1, math.pi / 2, 3.0]
    for give in (list, np.array):
        points, beams = scan_points(give(ranges), give(angles), USUAL)
        assert points == pytest.approx(np.array([[2.0, 0.0], [0.0, 3.0]]))
        assert beams.tolist() == [0, 2]
    for wrong in ((ranges, angles[:3]), ([ranges], [angles]), (2.0, 0.0)):
        with pytest.raises(ValueError, match="One scan needs as many ranges as angles"):
            scan_points(np.array(wrong[0]), np.array(wrong[1]), USUAL)


def test_angles_grow_and_turn_once_round_at_most():
    for right in ([], [3.0], [0.0, 1e-9], [-9.0, -9.0 + TURN], np.linspace(1.0, 1 + TURN, 9)):
        check_angles(np.array(right))
    for wrong in ([1.0, 1.0], [0.0, 1.0, 0.5], [0.2, 0.1]):
        with pytest.raises(ValueError, match="must grow from beam to beam"):
            check_angles(np.array(wrong))
    with pytest.raises(ValueError, match="turn more than once round"):
        check_angles(np.array([-1.0, 2.0, -1.0 + TURN + 1e-3]))


@pytest.mark.parametrize(
    ("angles", "full"),
    [
        (np.arange(8) * TURN / 8, True),
        (5 + np.arange(8) * TURN / 8, True),
        (np.arange(7) * TURN / 8, False),  # one beam is missing
        (5 + np.arange(7) * TURN / 8, False),
        (np.array([0.0, TURN - 0.1]), False),  # two beams are none
        (np.array([0.0, 3.0, 5.0]), True),
        (np.array([]), False),
        (np.linspace(0, TURN - 1.4 * 0.5, 12), True),
        # 0.743 and 0.753 are left; one and a half times the median is 0.75.
        (np.r_[np.arange(11) * 0.5, 5.54], True),
        (np.r_[np.arange(11) * 0.5, 5.53], False),
        (np.arange(11) * 0.5, False),
    ],
)
def test_after_a_full_turn_the_first_beam_follows_the_last(angles, full):
    assert is_full_turn(angles) is full


def test_a_gap_is_wider_than_what_a_grazed_wall_shows():
    """At 2 m, a step of 1 degree and a grazing angle of 10: 2 sin(1) / sin(9), and the noise."""
    one = math.radians(1.0)
    allowed = 2 * math.sin(one) / math.sin(9 * one) + 5 * math.sqrt(2) * 0.01
    angles = np.array([0.0, one])
    for wider, gap in ((-1e-6, False), (1e-6, True)):
        for turned in (1, -1):  # whichever of the two is nearer
            ranges = np.array([2.0, 5.0])[::turned]
            points = np.array([[0.0, 0.0], [0.6 * (allowed + wider), 0.8 * (allowed + wider)]])
            assert breaks(points, ranges, angles, USUAL).tolist() == [gap]


def test_neighbors_in_one_spot_are_apart_only_from_the_grazing_angle_on():
    points, ranges = np.zeros((2, 2)), np.ones(2)
    for step, gap in ((USUAL.grazing_angle, True), (USUAL.grazing_angle * 0.999, False)):
        assert breaks(points, ranges, np.array([0.0, step]), USUAL).tolist() == [gap]
    exact = Settings(sigma=0.0)
    assert breaks(points, np.zeros(2), np.array([0.0, 0.1]), exact).tolist() == [False]


FLAT = Line(2.0, math.pi / 2)


def along(count: int, length: float, bump: float = 0.0) -> np.ndarray:
    """Points of the wall y = 2 from right to left, the middle half moved up, the others down."""
    ys = np.full(count, 2.0 - bump)
    ys[count // 4 : count - count // 4] = 2.0 + bump
    return np.column_stack([np.linspace(0, -length, count), ys])


def test_a_wall_is_long_and_has_many_points_that_are_close():
    assert is_wall(along(8, 0.75), FLAT, Settings(min_length=0.75)) is True
    assert is_wall(along(8, 0.75)[::-1], FLAT, USUAL) is True
    assert is_wall(along(7, 0.75), FLAT, USUAL) is False
    assert is_wall(along(8, 0.59), FLAT, USUAL) is False
    rough = Settings(roughness=0.25, sigma=10.0)
    assert is_wall(along(8, 2.0, 0.25), FLAT, rough) is True
    assert is_wall(along(8, 2.0, 0.26), FLAT, rough) is False


def test_what_bends_is_no_wall():
    settings = Settings(sigma=0.001, roughness=1.0)
    assert is_wall(along(16, 2.0, 0.01), FLAT, settings) is False
    assert is_wall(along(16, 2.0, 0.0), FLAT, settings) is True


@pytest.mark.parametrize(
    ("N", "length", "middle", "curved"),
    [
        # 4 |middle| against 3 * 4 * 0.01 / sqrt(N), and 8 * 4 |middle| * 15 against length².
        (100, 1.0, 0.0031, True),
        (100, 1.0, -0.0031, True),
        (100, 1.0, 0.0029, False),  # by chance
        (25, 1.0, 0.0031, False),
        (25, 1.0, 0.0061, True),
        (100, 1.21, 0.0031, True),  # 1.488 and 1.464
        (100, 1.23, 0.0031, False),  # 1.488 and 1.513
        (100, 2.0, 0.0083, False),  # 3.98 and 4
        (100, 2.0, 0.0084, True),
    ],
)
def test_a_bend_counts_beyond_noise_and_below_the_least_radius(N, length, middle, curved):
    assert bool(is_curved(N, length, middle, USUAL)) is curved


def test_at_the_limits_a_bend_does_not_count():
    exact = Settings(sigma=0.25, min_radius=0.5)
    assert not is_curved(4, 0.0, 0.375, exact)  # 1.5 and 3 * 4 * 0.25 / 2
    assert is_curved(4, 0.0, 0.3750001, exact)
    none = Settings(sigma=0.0, min_radius=0.5)
    assert not is_curved(4, 2.0, 0.25, none)  # 8 * 1 * 0.5 and 2²


@pytest.mark.parametrize(
    ("turn", "bend"),
    [(0, False), (7.9, False), (8.1, True), (20, True), (29.9, True), (30.1, False), (90, False),
     (150.1, True), (149.9, False), (171.9, True), (172.1, False), (180, False), (188.1, True)],
)  # fmt: skip
def test_lines_that_meet_at_a_small_angle_are_of_something_round(turn, bend):
    for start in (0.0, 1.0, -3.0, 3.0):
        for sign in (1, -1):
            found = is_bend(start, start + sign * math.radians(turn), USUAL)
            assert bool(found) is bend


def test_at_exactly_the_limits_neighbors_are_no_bend():
    settings = Settings(straight_angle=0.25, corner_angle=0.5)
    assert not is_bend(0.0, 0.25, settings)
    assert is_bend(0.0, 0.2501, settings)
    assert not is_bend(0.0, 0.5, settings)


ROUND = np.arange(36) * TURN / 36  # steps of the grazing angle make gaps, so less:
FINE = Settings(grazing_angle=math.radians(25.0))


def test_less_than_a_full_turn_begins_with_its_first_beam():
    ranges = np.ones((3, 35))
    ranges[1, 7] = 1.1
    assert first_beams(ranges, ROUND[:35], FINE).tolist() == [0, 0, 0]


def test_a_full_turn_without_a_gap_begins_at_its_farthest_point():
    ranges = np.full((2, 36), 3.0)
    ranges[0, 7] = ranges[1, 20] = 3.1
    assert first_beams(ranges, ROUND, FINE).tolist() == [7, 20]


@pytest.mark.parametrize("behind", [0, 1, 17, 35])
def test_a_full_turn_begins_behind_its_widest_gap(behind):
    """Half the way round is near and half is far: two steps, of which the one out is wider."""
    ranges = np.full((3, 36), 3.0)
    ranges[0] = np.roll(np.r_[np.full(18, 9.0), np.full(18, 3.0)], behind)
    ranges[1] = np.roll(np.r_[np.full(5, np.nan), np.full(31, 3.0)], behind)  # no echo
    ranges[2] = np.nan
    ranges[0, (behind + 17) % 36] = 7.0  # the step back in is narrower
    found = first_beams(ranges, ROUND, FINE).tolist()
    assert found == [behind, (behind + 5) % 36, 0]


def test_a_beam_without_an_echo_is_not_the_farthest_point():
    ranges = np.full((1, 36), 0.5)
    ranges[0, 3], ranges[0, 20] = np.nan, 0.51
    wide = Settings(grazing_angle=math.radians(60.0))
    assert first_beams(ranges, ROUND, wide).tolist() == [20]


def test_a_scan_without_an_echo_begins_with_beam_0_and_the_others_are_looked_at():
    ranges = np.full((3, 36), 3.0)
    ranges[0] = ranges[2] = 60.0
    ranges[1, 11] = 3.1
    assert first_beams(ranges, ROUND, FINE).tolist() == [0, 11, 0]
