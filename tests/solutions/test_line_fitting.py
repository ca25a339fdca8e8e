import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from solutions.lines.line_fitting import (
    Line,
    distances,
    fit_line,
    line_covariance,
    point_at,
    positions_along,
)

angles = st.floats(-math.pi, math.pi, exclude_min=True)


def wall(line: Line, rng: np.random.Generator, noise: float = 0.02, count: int = 50) -> np.ndarray:
    points = point_at(rng.uniform(-3.0, 3.0, count), line)
    return points + rng.normal(0.0, noise, (count, 2))


def cost(points: np.ndarray, alpha: np.ndarray, weights: np.ndarray | None = None) -> np.ndarray:
    """The least sum of squared distances for every angle (r is then the mean of the feet)."""
    feet = np.cos(alpha)[:, None] * points[:, 0] + np.sin(alpha)[:, None] * points[:, 1]
    r = np.average(feet, axis=1, weights=weights)
    return np.average((feet - r[:, None]) ** 2, axis=1, weights=weights)


def test_a_diagonal_worked_by_hand():
    line = fit_line(np.array([[0.0, 1.0], [1.0, 2.0], [2.0, 3.0]]))
    assert line == pytest.approx((1 / math.sqrt(2), 3 * math.pi / 4))


def test_points_of_3x_plus_4y_equals_10():
    line = fit_line(np.array([[-2.0, 4.0], [2.0, 1.0], [6.0, -2.0]]))
    assert line == pytest.approx((2.0, math.atan2(4.0, 3.0)))


@pytest.mark.parametrize(
    ("start", "end", "expected"),
    [
        ((2, -1), (2, 5), (2, 0)),
        ((-2, -1), (-2, 5), (2, math.pi)),
        ((-1, 3), (4, 3), (3, math.pi / 2)),
        ((-1, -3), (4, -3), (3, -math.pi / 2)),
    ],
)
def test_walls_on_the_four_sides_have_normals_that_point_at_them(start, end, expected):
    assert fit_line(np.array([start, end], dtype=float)) == pytest.approx(expected)


@given(r=st.floats(0.01, 50.0), alpha=angles, seed=st.integers(0, 2**32 - 1))
def test_points_on_a_line_give_that_line_back(r, alpha, seed):
    points = wall(Line(r, alpha), np.random.default_rng(seed), noise=0.0)
    line = fit_line(points)
    assert line.r == pytest.approx(r, abs=1e-9)
    assert math.remainder(line.alpha - alpha, 2 * math.pi) == pytest.approx(0, abs=1e-9)


@given(alpha=angles, seed=st.integers(0, 2**32 - 1))
def test_the_line_is_the_one_that_svd_finds(alpha, seed):
    points = wall(Line(2.0, alpha), np.random.default_rng(seed), noise=0.2)
    center = points.mean(axis=0)
    normal = np.linalg.svd(points - center)[2][1]
    normal *= np.sign(normal @ center)
    line = fit_line(points)
    assert line.r == pytest.approx(normal @ center, abs=1e-9)
    assert [math.cos(line.alpha), math.sin(line.alpha)] == pytest.approx(list(normal), abs=1e-9)


@pytest.mark.parametrize("weighted", [False, True])
def test_no_other_angle_on_a_fine_grid_costs_less(weighted):
    rng = np.random.default_rng(5)
    grid = np.linspace(-math.pi, math.pi, 20001)
    for _ in range(20):
        points = rng.normal(size=(12, 2)) * rng.uniform(0.2, 2.0, 2) + rng.normal(size=2)
        weights = rng.uniform(0.0, 1.0, 12) if weighted else None
        line = fit_line(points, weights)
        best = np.average(distances(points, line) ** 2, weights=weights)
        assert best <= cost(points, grid, weights).min() * (1 + 1e-12)


@given(
    x=st.lists(st.floats(-1e3, 1e3), min_size=2, max_size=8),
    seed=st.integers(0, 2**32 - 1),
)
def test_the_convention_always_holds(x, seed):
    y = np.random.default_rng(seed).normal(size=len(x))
    line = fit_line(np.column_stack([x, y]))
    assert line.r >= 0
    assert -math.pi < line.alpha <= math.pi


def test_a_weight_of_three_is_a_point_seen_three_times():
    rng = np.random.default_rng(0)
    points = wall(Line(1.0, 0.4), rng, count=5)
    weights = np.array([3, 1, 2, 1, 0])
    repeated = np.repeat(points, weights, axis=0)
    assert fit_line(points, weights) == pytest.approx(fit_line(repeated))


@pytest.mark.parametrize("offset", [(1e6, 0.0), (-1e6, 1e6), (3e5, -1e6)])
def test_the_fit_is_as_good_1000_km_away(offset):
    rng = np.random.default_rng(1)
    near = np.round(wall(Line(2.0, 0.7), rng) * 2**20) / 2**20  # exact after adding the offset
    line, moved = fit_line(near), fit_line(near + offset)
    turned = moved.alpha - line.alpha
    assert abs(math.remainder(turned, math.pi)) < 1e-14
    expected = np.abs(distances(near, line))
    assert np.abs(distances(near + offset, moved)) == pytest.approx(expected, abs=1e-8)


@pytest.mark.parametrize(
    "points",
    [
        np.ones((4, 2)),
        np.full((7, 2), [1e6 + 0.1, 0.3]),
        np.array([[1.0, 0], [0, 1], [-1, 0], [0, -1]]),
        np.array([[0.1, 0], [0, 0.1], [-0.1, 0], [0, -0.1]]) + 1e6,
        np.array([[math.cos(a), math.sin(a)] for a in 2 * math.pi / 5 * np.arange(5)]) + 7.3,
    ],
    ids=["equal", "equal and far", "square", "square and far", "pentagon"],
)
def test_a_cloud_without_a_direction_is_reported(points):
    with pytest.raises(ValueError, match="No line"):
        fit_line(points)


@pytest.mark.parametrize("shape", [(0, 2), (1, 2), (3,), (3, 3)])
def test_an_array_of_another_shape_is_reported(shape):
    with pytest.raises(ValueError, match=r"\(N, 2\) array"):
        fit_line(np.zeros(shape))


def test_two_points_are_enough_even_if_they_are_close():
    line = fit_line(np.array([[5.0, 1.0], [5.0, 1.0 + 1e-9]]))
    assert line == pytest.approx((5.0, 0.0))


def test_distances_are_signed_and_positions_lead_back_to_the_points():
    line = Line(2.0, math.pi / 6)
    points = np.array([[0.0, 0.0], [math.sqrt(3), 1.0], [2 * math.sqrt(3), 2.0]])
    assert distances(points, line) == pytest.approx([-2.0, 0.0, 2.0])
    feet = point_at(positions_along(points, line), line)
    assert feet == pytest.approx(np.tile([math.sqrt(3), 1.0], (3, 1)))


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_points_that_are_not_finite_are_named(value):
    for function in (fit_line, lambda points: line_covariance(points, 0.01)):
        with pytest.raises(ValueError, match="some coordinates are not finite"):
            function(np.array([[0.0, 0.0], [value, 1.0], [2.0, 2.0]]))


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(
    "weights", [[0, 0, 0], [1, 1, -1], [1, math.nan, 1], [1, math.inf, 1], [1, 1], [[1, 1, 1]]]
)
def test_weights_that_cannot_be_are_explained(weights):
    points = np.array([[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]])
    for function in (fit_line, lambda p, w: line_covariance(p, 0.01, w)):
        with pytest.raises(ValueError, match="must be 3 finite numbers >= 0, not all of them 0"):
            function(points, weights)


def test_weights_count_by_their_ratios_however_small_they_are():
    points = np.array([[0.0, 1.0], [2.0, 1.5], [3.0, 4.0]])
    weights = np.array([2.0, 1.0, 5.0])
    assert fit_line(points, weights / 100) == pytest.approx(fit_line(points, weights))


def test_where_a_point_lies_along_a_line():
    line = Line(2.0, math.pi / 6)  # its foot is (sqrt 3, 1), and left of the normal is (-1/2, ...)
    foot, left = np.array([math.sqrt(3), 1.0]), np.array([-0.5, math.sqrt(3) / 2])
    for position in (-3.0, 0.0, 1.5):
        point = foot + position * left
        assert point_at(position, line) == pytest.approx(point)
        assert positions_along(point[None] + 4 * foot, line) == pytest.approx([position])
    many = point_at(np.array([1.0, -2.0]), line)
    assert many == pytest.approx(np.array([foot + left, foot - 2 * left]))
