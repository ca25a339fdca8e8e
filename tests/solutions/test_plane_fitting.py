"""The plane fit by itself: an exact plane, and what determines none."""

from __future__ import annotations

import math

import numpy as np
import pytest

from solutions.lines.plane_fitting import Plane, fit_plane, plane_distances

NORMAL = np.array([2.0, -1.0, 2.0]) / 3


def on_plane(r: float, count: int = 20) -> np.ndarray:
    """Points of the plane (2 x - y + 2 z) / 3 = r."""
    rng = np.random.default_rng(5)
    across = np.array([[1.0, 2.0, 0.0], [0.0, 2.0, 1.0]])  # both at right angles to the normal
    return r * NORMAL + rng.normal(size=(count, 2)) @ across


@pytest.mark.parametrize("r", [3.0, -3.0, 0.01])
def test_points_of_a_plane_give_it_back_with_the_normal_away_from_the_origin(r):
    points = on_plane(r)
    for given in (points, points.tolist()):
        plane = fit_plane(given)
        assert plane.r == pytest.approx(abs(r))
        assert plane.normal == pytest.approx(tuple(math.copysign(1, r) * NORMAL))
        assert all(type(entry) is float for entry in (plane.r, *plane.normal))


def test_distances_are_positive_on_the_side_of_the_normal():
    plane = Plane((0.0, 0.0, 1.0), 2.0)
    points = np.array([[5.0, 1.0, 2.0], [0.0, 7.0, 5.0], [0.0, 0.0, 0.0]])
    assert plane_distances(points, plane).tolist() == [0.0, 3.0, -2.0]


@pytest.mark.parametrize(
    "points",
    [np.zeros(3), np.zeros((5, 2)), np.zeros((4, 3, 3)), np.zeros((2, 3)), np.zeros((0, 3)), 3.0],
)
def test_what_are_not_three_points_in_space_are_refused(points):
    with pytest.raises(ValueError, match=r"A plane needs an \(N, 3\) array of 3 points or more"):
        fit_plane(points)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_a_coordinate_that_is_not_finite_is_refused(value):
    points = on_plane(1.0)
    points[3, 1] = value
    with pytest.raises(ValueError, match="not finite; remove those points"):
        fit_plane(points)


LINE = np.array([5.0, 0.0, 1.0]) + np.outer(np.linspace(-1, 4, 9), [1.0, 2.0, 3.0])


@pytest.mark.parametrize(
    "points",
    [
        np.zeros((4, 3)),
        np.ones((4, 3)),
        np.full((4, 3), 1e6),
        LINE,
        LINE + 1e6,
        np.vstack([np.eye(3), -np.eye(3)]),  # as wide in all directions
    ],
)
def test_points_that_determine_no_plane_are_refused(points):
    with pytest.raises(ValueError, match="on one line, or equally thin in two directions"):
        fit_plane(points)


def test_the_least_three_points_are_enough():
    assert fit_plane(np.eye(3)).r == pytest.approx(1 / math.sqrt(3))
