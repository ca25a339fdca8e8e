import itertools
import math

import numpy as np
import pytest

from autograder.kinds.function.inside.counted_draws import CountedDraws
from solutions.lines.line_fitting import Line, distances, fit_line, point_at
from solutions.lines.plane_fitting import Plane, fit_plane, plane_distances
from solutions.ransac import line as ransac_loop
from solutions.ransac import plane as plane_loop
from solutions.ransac.fast.consensus import (
    draw_samples,
    ransac_line,
    ransac_plane,
    required_iterations,
)
from solutions.ransac.walls import find_walls

THRESHOLD = 0.02


def wall_among_outliers(rng: np.random.Generator, N: int = 400, inliers: int = 120) -> np.ndarray:
    """The first `inliers` points are on 3x + 4y = 10, up to noise within the threshold."""
    wall = point_at(rng.uniform(-5, 5, inliers), Line(2.0, math.atan2(4, 3)))
    wall += rng.uniform(-0.5, 0.5, wall.shape) * THRESHOLD
    return np.vstack([wall, rng.uniform(-6, 6, (N - inliers, 2))])


def floor_among_outliers(rng: np.random.Generator, N: int = 400, inliers: int = 160) -> np.ndarray:
    """The first `inliers` points are on x + 2y + 2z = 3, up to noise within the threshold."""
    x, y = rng.uniform(-5, 5, (2, inliers))
    floor = np.column_stack([x, y, (3 - x - 2 * y) / 2])
    floor += rng.uniform(-0.3, 0.3, floor.shape) * THRESHOLD
    return np.vstack([floor, rng.uniform(-6, 6, (N - inliers, 3))])


@pytest.mark.parametrize(("N", "s"), [(2, 2), (3, 2), (5, 2), (3, 3), (5, 3), (6, 4)])
def test_samples_have_no_point_twice_and_every_set_is_equally_likely(N, s):
    draws = 20000
    samples = np.sort(draw_samples(N, s, draws, np.random.default_rng(1)), axis=0)
    sets, counts = np.unique(samples, axis=1, return_counts=True)
    assert sets.T.tolist() == [list(c) for c in itertools.combinations(range(N), s)]
    expected = draws / math.comb(N, s)
    chi_squared = np.sum((counts - expected) ** 2 / expected)
    assert chi_squared < len(counts) - 1 + 5 * math.sqrt(2 * len(counts))


@pytest.mark.parametrize("seed", range(10))
def test_the_wall_is_found_among_outliers(seed):
    rng = np.random.default_rng(seed)
    found = ransac_line(wall_among_outliers(rng), THRESHOLD, 200, rng)
    assert found.model.r == pytest.approx(2.0, abs=THRESHOLD / 4)
    assert found.model.alpha == pytest.approx(math.atan2(4, 3), abs=THRESHOLD / 10)
    assert set(range(120)) <= set(found.inliers)
    assert found.iterations == 200


@pytest.mark.parametrize("seed", range(10))
def test_the_floor_is_found_among_outliers(seed):
    rng = np.random.default_rng(seed)
    found = ransac_plane(floor_among_outliers(rng), THRESHOLD, 300, rng)
    assert found.model.normal == pytest.approx((1 / 3, 2 / 3, 2 / 3), abs=THRESHOLD / 5)
    assert found.model.r == pytest.approx(1.0, abs=THRESHOLD / 5)
    assert set(range(160)) <= set(found.inliers)


@pytest.mark.parametrize("scale", [0.01, 1.0, 100.0])
def test_a_plane_is_found_as_surely_whatever_its_size(scale):
    for seed in range(40):
        rng = np.random.default_rng(seed)
        points = floor_among_outliers(rng, N=100, inliers=60) * scale
        found = ransac_plane(points, 2 * THRESHOLD * scale, 80, rng)
        assert set(range(60)) <= set(found.inliers.tolist())


def test_the_refit_goes_on_while_it_gains_points():
    """Two points may be close together: the first fit then has a part of the wall only."""
    for seed in range(40):
        rng = np.random.default_rng(seed)
        wall = np.column_stack([rng.uniform(0, 4, 200), 1 + rng.normal(0, 0.01, 200)])
        found = ransac_line(wall, 0.025, 1, rng)
        assert len(found.inliers) >= 190


@pytest.mark.parametrize("seed", range(5))
def test_one_iteration_is_enough_where_any_sample_gives_the_model(seed):
    rng = np.random.default_rng(seed)
    wall = point_at(rng.uniform(-5, 5, 12), Line(2.0, math.atan2(4, 3)))
    floor = np.column_stack([rng.uniform(-5, 5, (12, 2)), np.full(12, 3.0)])
    assert ransac_line(wall, THRESHOLD, 1, rng).inliers.tolist() == list(range(12))
    assert ransac_plane(floor, THRESHOLD, 1, rng).inliers.tolist() == list(range(12))
    for loop, points in ((ransac_loop.ransac_line, wall), (plane_loop.ransac_plane, floor)):
        _, inliers = loop(points, THRESHOLD, 1, rng)
        assert inliers.tolist() == list(range(12))
        with pytest.raises(ValueError, match=r"No (line|plane)"):
            loop(points, THRESHOLD, 0, rng)


def test_a_point_exactly_at_the_threshold_agrees():
    """The wall x = 2: these distances are exact in floating point."""
    wall = np.column_stack([np.full(20, 2.0), np.arange(20.0)])
    points = np.vstack([wall, [[2.5, 9.5], [1.5, 9.5], [2.75, 9.5]]])
    line, inliers = ransac_loop.ransac_line(points, 0.5, 60, np.random.default_rng(0))
    assert line == pytest.approx((2.0, 0.0))
    assert inliers.tolist() == list(range(22))
    floor = np.array([[x, y, 2.0] for x in range(5) for y in range(5)])
    points = np.vstack([floor, [[2.0, 2, 2.5], [2, 2, 1.5], [2, 2, 2.75]]])
    plane, inliers = plane_loop.ransac_plane(points, 0.5, 60, np.random.default_rng(0))
    assert plane.normal == pytest.approx((0.0, 0.0, 1.0))
    assert plane.r == pytest.approx(2.0)
    assert inliers.tolist() == list(range(27))


@pytest.mark.parametrize("seed", range(3))
def test_the_loop_keeps_the_plane_of_the_floor_and_not_the_last_one(seed):
    rng = np.random.default_rng(seed)
    plane, inliers = plane_loop.ransac_plane(floor_among_outliers(rng), THRESHOLD, 300, rng)
    assert plane.normal == pytest.approx((1 / 3, 2 / 3, 2 / 3), abs=THRESHOLD / 5)
    assert np.isin(np.arange(160), inliers).mean() > 0.97


@pytest.mark.parametrize("iterations", [1, 7, 30])
def test_the_loops_draw_as_many_samples_as_they_are_told(iterations):
    for loop, s in ((ransac_loop.ransac_line, 2), (plane_loop.ransac_plane, 3)):
        rng = CountedDraws(1)
        loop(np.random.default_rng(0).uniform(-1, 1, (20, s)), THRESHOLD, iterations, rng)
        assert rng.drawn == s * iterations


@pytest.mark.parametrize("seed", range(5))
def test_all_at_once_finds_what_the_loop_finds(seed):
    points = wall_among_outliers(np.random.default_rng(seed))
    line, inliers = ransac_loop.ransac_line(points, THRESHOLD, 300, np.random.default_rng(1))
    found = ransac_line(points, THRESHOLD, 300, np.random.default_rng(2))
    assert found.model == pytest.approx(line, abs=THRESHOLD / 10)
    assert np.isin(inliers, found.inliers).mean() > 0.97


def test_no_pair_of_points_has_more_on_its_line_than_the_result_before_refitting():
    rng = np.random.default_rng(3)
    points = wall_among_outliers(rng, N=40, inliers=15)
    counts = [
        np.count_nonzero(np.abs(distances(points, fit_line(points[list(pair)]))) <= THRESHOLD)
        for pair in itertools.combinations(range(40), 2)
    ]
    found = ransac_line(points, THRESHOLD, 20000, rng)  # every pair, for certain
    assert len(found.inliers) >= max(counts) - 1  # the refit may trade one for a better line


def test_model_and_inliers_fit_together():
    rng = np.random.default_rng(4)
    points = wall_among_outliers(rng)
    found = ransac_line(points, THRESHOLD, 100, rng)
    assert np.array_equal(
        found.inliers, np.flatnonzero(np.abs(distances(points, found.model)) <= THRESHOLD)
    )


def test_the_same_random_numbers_give_the_same_result_and_leave_the_points_alone():
    points = wall_among_outliers(np.random.default_rng(0))
    copy = points.copy()
    first, second = (ransac_line(points, THRESHOLD, 5, np.random.default_rng(7)) for _ in "ab")
    assert first.model == second.model
    assert np.array_equal(points, copy)


def test_failures_are_as_rare_as_the_formula_says():
    # Without noise a line is found exactly when a sample was free of outliers.
    rng = np.random.default_rng(5)
    points = rng.uniform(-5, 5, (100, 2))
    points[:30, 1] = 1.0
    k, runs = 20, 1500
    failures = sum(len(ransac_line(points, 1e-9, k, rng).inliers) < 30 for _ in range(runs))
    predicted = (1 - 30 * 29 / (100 * 99)) ** k
    assert failures / runs == pytest.approx(predicted, abs=4 * math.sqrt(predicted / runs))


def test_adaptive_stopping_draws_what_the_inlier_ratio_requires():
    rng = np.random.default_rng(6)
    points = wall_among_outliers(rng, N=20000, inliers=12000)
    found = ransac_line(points, THRESHOLD, 10_000, rng, confidence=0.99)
    share = len(found.inliers) / len(points)
    assert required_iterations(0.99, share, 2) <= found.iterations < 50
    assert set(range(12000)) <= set(found.inliers)


def test_adaptive_stopping_never_exceeds_the_given_iterations():
    rng = np.random.default_rng(7)
    found = ransac_line(rng.uniform(-1, 1, (300, 2)), 1e-3, 700, rng, confidence=0.99)
    assert found.iterations == 700


@pytest.mark.parametrize("offset", [0.0, 1e6])
def test_offsets_and_tiny_thresholds_lose_no_inlier(offset):
    rng = np.random.default_rng(8)
    x = np.round(rng.uniform(-5, 5, 200) * 2**20) / 2**20  # exact after adding the offset
    points = np.column_stack([x, 0.5 * x + 1]) + offset
    points[100:, 1] += np.round(rng.uniform(1, 3, 100) * 2**20) / 2**20
    found = ransac_line(points, 1e-7, 100, rng)
    assert found.inliers.tolist() == list(range(100))


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("first", [1e6, 1e30, 1e200])
def test_a_mark_for_no_echo_may_be_the_first_point(first):
    rng = np.random.default_rng(10)
    x = rng.uniform(-5, 5, 100)
    points = np.vstack([np.full((3, 2), first), np.column_stack([x, 0.5 * x + 1])])
    found = ransac_line(points, THRESHOLD, 100, rng)
    assert found.inliers.tolist() == list(range(3, 103))


def test_a_consensus_set_as_wide_as_long_gives_no_line():
    corners = np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])
    assert ransac_line(corners, 2.0, 10, np.random.default_rng(0)) is None


def test_more_points_than_a_small_integer_can_count():
    rng = np.random.default_rng(9)
    points = np.column_stack([rng.uniform(-5, 5, 70000), np.zeros(70000)])
    assert len(ransac_line(points, 0.01, 3, rng).inliers) == 70000


@pytest.mark.parametrize("seed", range(5))
def test_the_loops_pass_over_samples_of_equal_points(seed):
    rng = np.random.default_rng(seed)
    wall = np.repeat(wall_among_outliers(rng, N=40, inliers=20), 3, axis=0)
    line, inliers = ransac_loop.ransac_line(wall, THRESHOLD, 300, rng)
    assert line == pytest.approx(Line(2.0, math.atan2(4, 3)), abs=THRESHOLD / 4)
    assert set(range(60)) <= set(inliers)
    ((found, _),) = find_walls(wall, THRESHOLD, 300, 30, rng)
    assert found == pytest.approx(line, abs=THRESHOLD / 4)


def test_the_loops_say_when_no_sample_gave_a_model():
    rng = np.random.default_rng(0)
    with pytest.raises(ValueError, match="no sample had two different points"):
        ransac_loop.ransac_line(np.ones((9, 2)), THRESHOLD, 10, rng)
    points = np.outer(np.arange(10.0), [1.0, 2.0, 4.0])
    with pytest.raises(ValueError, match="the points of each sample were on one line"):
        plane_loop.ransac_plane(points, THRESHOLD, 10, rng)


def test_a_heap_of_points_in_one_spot_is_no_wall():
    rng = np.random.default_rng(0)
    wall = np.column_stack([np.linspace(0, 3, 40), np.full(40, 1.0)])
    points = np.vstack([wall, np.zeros((20, 2))])  # beams without an echo, say
    ((line, indices),) = find_walls(points, THRESHOLD, 200, 10, rng)
    assert line == pytest.approx((1.0, math.pi / 2))
    assert indices.tolist() == list(range(40))
    assert find_walls(np.zeros((0, 2)), THRESHOLD, 200, 0, rng) == []


@pytest.mark.parametrize("spot", [(0.0, 0.0), (0.1, 1e6)])
def test_identical_points_give_no_model(spot):
    rng = np.random.default_rng(0)
    assert ransac_line(np.full((9, 2), spot), THRESHOLD, 10, rng) is None
    assert ransac_plane(np.full((9, 3), (*spot, 1.0)), THRESHOLD, 10, rng) is None


def test_points_on_one_line_give_no_plane():
    points = np.outer(np.arange(10.0), [1.0, 2.0, 4.0])
    assert ransac_plane(points, THRESHOLD, 10, np.random.default_rng(0)) is None


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"points": np.zeros((1, 2))}, "A sample needs 2 points"),
        ({"points": np.zeros((5, 3))}, r"\(N, 2\) array"),
        ({"points": np.array([[0.0, math.nan], [1, 1], [2, 2]])}, "not finite"),
        ({"threshold": 0.0}, "threshold > 0"),
        ({"threshold": math.nan}, "threshold > 0"),
        ({"iterations": 0}, "iterations >= 1"),
        ({"iterations": math.inf}, "whole number of iterations"),
        ({"iterations": 7.5}, "whole number of iterations"),
        ({"confidence": 1.0}, "between 0 and 1"),
    ],
)
def test_bad_input_is_explained(change, message):
    arguments = {"points": np.eye(2), "threshold": 0.1, "iterations": 5, "confidence": None}
    with pytest.raises(ValueError, match=message):
        ransac_line(**{**arguments, **change}, rng=np.random.default_rng(0))


@pytest.mark.parametrize("seed", range(5))
def test_a_fitted_plane_is_the_one_that_svd_finds(seed):
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(30, 3)) @ rng.normal(size=(3, 3)) + rng.normal(size=3) * 5
    center = points.mean(axis=0)
    normal = np.linalg.svd(points - center)[2][2]
    normal *= np.sign(normal @ center)
    plane = fit_plane(points)
    assert plane.normal == pytest.approx(tuple(normal), abs=1e-9)
    assert plane.r == pytest.approx(normal @ center)


def test_a_plane_worked_by_hand():
    points = np.array([[3.0, 0, 0], [0, 1.5, 0], [0, 0, 1.5], [1, 0.5, 0.5]])
    plane = fit_plane(points)
    assert plane.normal == pytest.approx((1 / 3, 2 / 3, 2 / 3))
    assert plane.r == pytest.approx(1.0)
    assert plane_distances(np.array([[4.0, 1, 0]]), plane) == pytest.approx([1.0])
    assert plane_distances(points + 2e6, Plane(plane.normal, plane.r)) == pytest.approx(10e6 / 3)


@pytest.mark.parametrize(
    ("points", "message"),
    [
        (np.zeros((2, 3)), r"\(N, 3\) array"),
        (np.full((4, 3), math.inf), "not finite"),
        (np.outer(np.arange(5.0), [1, 2, 3]) + 1e6, "No plane"),
        (np.vstack([np.eye(3), -np.eye(3)]), "No plane"),
    ],
)
def test_a_cloud_without_a_plane_is_reported(points, message):
    with pytest.raises(ValueError, match=message):
        fit_plane(points)


def test_a_model_that_the_fit_leaves_without_inliers_is_no_model(monkeypatch):
    """A fit may lose all points: one whose line lies elsewhere stands for that."""
    from solutions.ransac.fast import consensus

    monkeypatch.setattr(consensus, "fit_line", lambda points: Line(100.0, 0.0))
    points = np.column_stack([np.arange(9.0), np.zeros(9)])
    assert ransac_line(points, 0.1, 5, np.random.default_rng(0)) is None
