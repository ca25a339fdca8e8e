"""The taught RANSAC with samples that are handed out: exact thresholds, and when a search ends."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from solutions.ransac.adaptive import adaptive_stop, msac_cost
from solutions.ransac.line import ransac_line
from solutions.ransac.plane import ransac_plane
from solutions.ransac.walls import find_walls


class HandsOut(np.random.Generator):
    """A generator that draws these samples, one after the other."""

    def __init__(self, *samples: list[int]) -> None:
        super().__init__(np.random.PCG64(0))
        self._samples = list(samples)

    def choice(self, *given: Any, **how: Any) -> Any:
        return np.array(self._samples.pop(0))


def row(x: float, count: int) -> list[list[float]]:
    return [[x, float(y)] for y in range(count)]


def test_a_point_at_exactly_the_threshold_agrees_with_a_line():
    """Eight points and two at the threshold are more than nine; all numbers here are exact."""
    points = np.array([*row(2.0, 8), [2.25, 4.0], [1.75, 4.0], *row(50.0, 9)])
    line, inliers = ransac_line(points, 0.25, 2, HandsOut([0, 7], [10, 18]))
    assert line == pytest.approx((2.0, 0.0))
    assert inliers.tolist() == list(range(10))


def test_a_point_at_exactly_the_threshold_agrees_with_a_plane():
    corners = [[0, 0, 2], [4, 0, 2], [0, 4, 2], [4, 4, 2]]
    edge = [[2, 2, 2.25], [2, 2, 1.75]]
    above = [[0, 0, 50], [4, 0, 50], [0, 4, 50], [4, 4, 50], [1, 1, 50]]
    points = np.array([*corners, *edge, *above], dtype=float)
    plane, inliers = ransac_plane(points, 0.25, 2, HandsOut([0, 1, 2], [6, 7, 8]))
    assert plane.r == pytest.approx(2.0)
    assert inliers.tolist() == list(range(6))


def test_walls_of_just_enough_points_are_found_until_too_few_are_left():
    points = np.array([*row(2.0, 5), *row(20.0, 7), *row(40.0, 6), [90.0, 0.5]])
    walls = find_walls(points, 0.1, 200, 5, np.random.default_rng(1))
    assert [len(indices) for _, indices in walls] == [7, 6, 5]
    assert [line.r for line, _ in walls] == pytest.approx([20.0, 40.0, 2.0])
    assert sorted(np.concatenate([indices for _, indices in walls])) == list(range(18))


def test_the_search_ends_where_the_best_line_has_too_few_points_or_there_is_none():
    scattered = [[9.0, 1.0], [11.5, 4.0], [14.0, 0.5], [17.5, 5.5], [21.0, 2.5], [30.0, 9.0]]
    for others in (scattered, [[9.0, 1.0]] * 6):
        points = np.array([*row(2.0, 7), *others])
        ((line, indices),) = find_walls(points, 0.1, 200, 5, np.random.default_rng(1))
        assert line.r == pytest.approx(2.0)
        assert sorted(indices) == list(range(7))


def test_two_points_are_a_wall_where_two_are_enough():
    walls = find_walls(np.array([[2.0, 0.0], [2.0, 1.0]]), 0.1, 5, 2, np.random.default_rng(1))
    assert [len(indices) for _, indices in walls] == [2]
    assert find_walls(np.array([[2.0, 0.0]]), 0.1, 5, 1, np.random.default_rng(1)) == []


@pytest.mark.parametrize(
    ("agreeing", "stop"),
    [
        # For p = 0.9: w = 0.2 asks for 57 samples, 0.5 for 9, 0.8 for 3, and 1 for one.
        ([10], 1),
        ([2, 10], 2),
        ([8, 8, 8, 8], 3),
        ([8, 2, 2, 9], 3),  # the best so far counts
        ([2, 2, 8, 2], 3),
        ([2, 2, 2, 8, 2], 4),  # more are drawn by then than are required
        ([5] * 20, 9),
        ([2, 2, 2], 3),  # all that there are
        ([], 0),
    ],
)
def test_an_adaptive_search_stops_as_soon_as_enough_samples_are_drawn(agreeing, stop):
    assert adaptive_stop(np.array(agreeing, dtype=int), 10, 0.9) == stop


def test_an_outlier_costs_as_much_as_a_point_at_the_threshold():
    offsets = np.array([0.1, -0.2, 0.3, 0.5, -3.0])
    assert msac_cost(offsets, 0.3) == pytest.approx(0.01 + 0.04 + 3 * 0.09)
    assert msac_cost(offsets, 0.15) == pytest.approx(0.01 + 4 * 0.0225)
    assert msac_cost(np.zeros(0), 0.3) == 0.0
    assert type(msac_cost(offsets, 0.3)) is float
