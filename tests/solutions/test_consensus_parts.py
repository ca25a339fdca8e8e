"""The parts of the fast RANSAC one by one: hypotheses, the middle, the best of all, the refit."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from solutions.lines.line_fitting import fit_line
from solutions.lines.plane_fitting import fit_plane
from solutions.ransac.fast import consensus
from solutions.ransac.fast.consensus import draw_samples, ransac_line, ransac_plane

# Lines and planes at all angles, some of them along an axis.
POINTS = np.random.default_rng(3).normal(2.0, 3.0, (60, 3))
POINTS[:4] = [[1, 2, 9], [1, 5, 9], [4, 2, 9], [1, 2, 7]]


@pytest.mark.parametrize("rng", [None, 7, np.random])
def test_samples_are_drawn_with_a_generator(rng):
    with pytest.raises(TypeError, match=r"drawn with a np\.random\.Generator, not with"):
        draw_samples(9, 2, 4, rng)


@pytest.mark.parametrize(("N", "s"), [(5, 2), (5, 3), (3, 3), (2, 2)])
def test_every_sample_is_as_likely_as_any_other(N, s):
    samples = draw_samples(N, s, 6000, np.random.default_rng(0))
    assert samples.shape == (s, 6000)
    drawn, counts = np.unique(np.sort(samples, axis=0), axis=1, return_counts=True)
    assert (np.diff(drawn, axis=0) > 0).all()
    kinds = consensus.candidate_count(N, s)
    assert drawn.shape[1] == kinds
    assert counts == pytest.approx(6000 / kinds, abs=5 * (6000 / kinds) ** 0.5)


def test_a_line_through_two_points_is_the_one_that_is_fitted_to_them():
    x, y = POINTS[:, :2].reshape(30, 2, 2).transpose(2, 1, 0)
    for normal_x, normal_y, r, a, b in zip(*consensus._lines_through(x, y), x.T, y.T, strict=True):
        line = fit_line(np.column_stack([a, b]))
        sign = 1 if r >= 0 else -1
        expected = (line.r, np.cos(line.alpha), np.sin(line.alpha))
        assert (sign * r, sign * normal_x, sign * normal_y) == pytest.approx(expected)


def test_a_plane_through_three_points_is_the_one_that_is_fitted_to_them():
    x, y, z = POINTS.reshape(20, 3, 3).transpose(2, 1, 0)
    for *normal, r, a, b, c in zip(*consensus._planes_through(x, y, z), x.T, y.T, z.T, strict=True):
        plane = fit_plane(np.column_stack([a, b, c]))
        sign = 1 if r >= 0 else -1
        assert (sign * r, *(sign * n for n in normal)) == pytest.approx((plane.r, *plane.normal))


@pytest.mark.parametrize(("N", "step"), [(24, 1), (25, 1), (26, 2), (100, 4), (101, 5)])
def test_the_middle_is_the_median_of_25_points_at_most(N, step):
    points = np.random.default_rng(N).normal(size=(N, 2))
    points[1::7] = 1e30  # no echo
    some = points[::step]
    assert len(some) <= 25
    upper = [sorted(column)[len(some) // 2] for column in some.T.tolist()]
    assert consensus._middle(points).tolist() == upper


def vertical(x: float, ys: range) -> list[list[float]]:
    return [[x, float(y)] for y in ys]


def hand_out(monkeypatch: pytest.MonkeyPatch, points: np.ndarray, samples: list[list[int]]) -> None:
    """These samples in place of random ones, and one hypothesis in a block."""
    monkeypatch.setattr(consensus, "BLOCK", len(points))
    monkeypatch.setattr(consensus, "draw_samples", lambda *_: np.array(samples).T)


@pytest.mark.parametrize("best", [0, 1, 2])
def test_the_best_hypothesis_is_kept_in_whichever_block_it_is(monkeypatch, best):
    points = np.array(vertical(2.0, range(9)) + vertical(50.0, range(5)) + vertical(90.0, range(4)))
    samples = [[9, 10], [14, 15]]
    samples.insert(best, [0, 8])
    hand_out(monkeypatch, points, samples)
    found = ransac_line(points, 0.1, 3, np.random.default_rng(0))
    assert found is not None
    assert found.inliers.tolist() == list(range(9))
    assert found.iterations == 3


def test_a_point_at_exactly_the_threshold_agrees_when_hypotheses_are_counted(monkeypatch):
    """Eight points and two at the threshold are more than nine; all numbers here are exact."""
    edge = [[2.25, 4.0], [1.75, 4.0]]
    points = np.array(vertical(2.0, range(8)) + edge + vertical(50.0, range(9)))
    hand_out(monkeypatch, points, [[0, 7], [10, 18]])
    found = ransac_line(points, 0.25, 2, np.random.default_rng(0))
    assert found is not None
    assert found.inliers.tolist() == list(range(10))


def test_the_search_ends_with_the_sample_that_makes_it_as_certain_as_asked_for(monkeypatch):
    points = np.array(vertical(2.0, range(9)))
    hand_out(monkeypatch, points, [[0, 7], [0, 8], [1, 8]])
    found = ransac_line(points, 0.25, 3, np.random.default_rng(0), confidence=0.9)
    assert found is not None
    assert found.iterations == 1  # all points agree
    others = [[7.0, 1.5], [11.0, 3.5], [31.0, 0.2], [47.0, 5.1]]
    points = np.array([*vertical(2.0, range(6)), *others])
    hand_out(monkeypatch, points, [[0, 5]] * 9)
    found = ransac_line(points, 0.25, 9, np.random.default_rng(0), confidence=0.9)
    assert found is not None
    assert found.iterations == 6  # log(0.1) / log(1 - 0.6**2) is 5.16


class Fake:
    """A model of whatever points agree, with distances as they are given, one set a fit."""

    sample_size = 2

    def __init__(self, *distances: list[float]) -> None:
        self.left, self.fits = list(distances), 0

    def fit(self, points: np.ndarray) -> int:
        self.fits += 1
        return self.fits

    def distances(self, points: np.ndarray, model: int) -> np.ndarray:
        return np.array(self.left.pop(0))


def refit(kind: Any, agree: int, N: int) -> Any:
    return consensus._refit(kind, np.zeros((N, 2)), np.arange(N) < agree, 1.0, 7)


def test_the_fit_is_repeated_only_while_more_than_a_percent_more_points_agree():
    def near(count: int) -> list[float]:
        return [0.5] * count + [-3.0] * (300 - count)

    for counts, fits in (
        ([100], 1),
        ([101], 1),  # a percent more, and not over it
        ([102, 103], 2),
        ([102, 104, 105], 3),
        ([90], 1),
    ):
        kind = Fake(*map(near, counts))
        found = refit(kind, 100, 300)
        assert kind.fits == fits
        assert (found.model, found.iterations) == (fits, 7)
        assert found.inliers.tolist() == list(range(counts[-1]))


def test_a_point_at_exactly_the_threshold_agrees_with_the_fit_on_either_side():
    assert refit(Fake([1.0, -1.0, 0.0, 1.0000001]), 4, 4).inliers.tolist() == [0, 1, 2]


def test_a_fit_that_loses_its_points_is_none():
    assert refit(Fake([0.0, 0.0, 9.0, 9.0]), 4, 4).inliers.tolist() == [0, 1]
    assert refit(Fake([0.0, -9.0, 9.0, 9.0]), 4, 4) is None


@pytest.mark.parametrize("ransac", [ransac_line, ransac_plane])
def test_what_cannot_be_searched_is_refused_in_one_sentence(ransac):
    axes = 2 if ransac is ransac_line else 3
    rng, points = np.random.default_rng(0), np.random.default_rng(1).normal(size=(9, axes))
    for wrong, said in (
        (points[0], "must be an"),
        (points[:, :1], "must be an"),
        (points[None], "must be an"),
        (points[: axes - 1], f"A sample needs {axes} points"),
        (np.where(np.arange(9)[:, None] == 4, np.inf, points), "not finite"),
    ):
        with pytest.raises(ValueError, match=said):
            ransac(wrong, 0.1, 5, rng)
    for threshold, iterations in (
        (0.0, 5),
        (-1.0, 5),
        (np.nan, 5),
        (0.1, 0),
        (0.1, 5.0),
        (0.1, -1),
    ):
        with pytest.raises(ValueError, match="Needs threshold > 0 and a whole number"):
            ransac(points, threshold, iterations, rng)
    for confidence in (0.0, 1.0, -0.5, 1.5):
        with pytest.raises(ValueError, match="confidence must be between 0 and 1"):
            ransac(points, 0.1, 5, rng, confidence)
    assert ransac(points.tolist(), 9.0, 1, rng) is not None
    assert ransac(points[:axes], 9.0, np.int64(1), rng, 0.5) is not None
