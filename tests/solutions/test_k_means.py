"""k-means by its steps: how often it looks, what it starts from, where an empty cluster goes."""

from __future__ import annotations

import numpy as np
import pytest

from solutions.place_recognition import k_means as package_function
from solutions.place_recognition.k_means import _moved, k_means

POINTS = np.random.default_rng(4).normal(size=(200, 3)).astype(np.float32)


@pytest.fixture
def looks(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """How many centres there were each time that the nearest ones were looked for."""
    seen: list[int] = []
    names = k_means.__globals__
    real = names["nearest_centers"]

    def counted(points: np.ndarray, centers: np.ndarray) -> np.ndarray:
        seen.append(len(centers))
        found: np.ndarray = real(points, centers)
        return found

    monkeypatch.setitem(names, "nearest_centers", counted)
    return seen


def test_it_looks_as_often_as_it_may_and_once_more_for_what_is_left(looks):
    k_means(POINTS, 20, np.random.default_rng(0), iterations=3)
    assert looks == [20] * 4
    looks.clear()
    many = np.random.default_rng(5).normal(size=(2000, 3)).astype(np.float32)
    k_means(many, 20, np.random.default_rng(0))
    assert looks == [20] * 11


def test_it_ends_when_no_point_changes_its_cluster(looks):
    two = np.repeat(np.array([[0.0, 0.0], [9.0, 9.0]], np.float32), 5, axis=0)
    two += np.arange(10, dtype=np.float32)[:, None] / 100
    centers = k_means(two, 2, np.random.default_rng(0), iterations=50)
    assert len(looks) < 6
    assert np.sort(centers, axis=0) == pytest.approx(np.array([[0.02, 0.02], [9.07, 9.07]]))


def test_it_starts_from_different_points():
    for seed in range(20):
        centers = k_means(POINTS[:9], 9, np.random.default_rng(seed), iterations=0)
        assert len(centers) == 9


def test_one_cluster_has_the_mean_of_all():
    (center,) = k_means(POINTS, 1, np.random.default_rng(0))
    assert center == pytest.approx(POINTS.mean(axis=0), abs=1e-6)
    assert package_function is k_means


@pytest.mark.parametrize("far", [-9.0, 9.0])
def test_an_empty_cluster_starts_anew_at_the_farthest_point_on_either_side(far):
    points = np.array([[0.0], [1.0], [far], [-1.0]], np.float32)
    centers = np.array([[0.0], [100.0]], np.float32)
    moved = _moved(points, np.zeros(4, int), centers)
    assert moved.ravel().tolist() == pytest.approx([far / 4, far])
