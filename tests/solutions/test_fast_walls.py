"""Walls one after the other: when the search looks, cuts and ends."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from solutions.lines.line_fitting import Line
from solutions.lines.scan import Segment, Settings
from solutions.ransac.fast import walls
from solutions.ransac.fast.consensus import Consensus
from solutions.ransac.fast.walls import sequential_ransac

FLAT = Line(2.0, math.pi / 2)  # the wall y = 2, along which x falls


def wall(xs: Any, y: float = 2.0) -> np.ndarray:
    return np.column_stack([xs, np.full(len(xs), y)])


def search(
    monkeypatch: pytest.MonkeyPatch,
    points: np.ndarray,
    found: list[Consensus | None] | None = None,
    **how: Any,
) -> tuple[list[Segment], list[tuple[Any, ...]]]:
    """The walls among these points, and what RANSAC was asked; it may be told what it finds."""
    asked: list[tuple[Any, ...]] = []
    real = walls.ransac_line

    def asked_for(*given: Any) -> Consensus | None:
        asked.append(given)
        return real(*given) if found is None else found[len(asked) - 1]

    beams = 100 + np.arange(len(points))
    monkeypatch.setattr(walls, "scan_points", lambda ranges, angles, settings: (points, beams))
    monkeypatch.setattr(walls, "ransac_line", asked_for)
    nothing, rng = np.zeros(0), np.random.default_rng(0)
    segments = sequential_ransac(nothing, nothing, rng, **how)
    assert all(given[3] is rng for given in asked)
    return segments, asked


def test_ransac_is_asked_for_what_the_settings_say(monkeypatch):
    points = wall(np.linspace(0, 2, 9))
    _, asked = search(monkeypatch, points)
    given, threshold, iterations, _ = asked[0]
    assert np.array_equal(given, points)
    assert (threshold, iterations) == (0.04, 200)
    _, asked = search(monkeypatch, points, settings=Settings(roughness=0.03), iterations=7)
    assert asked[0][1:3] == (0.06, 7)


def test_as_few_points_as_make_a_wall_are_looked_at_and_found(monkeypatch):
    for least, count in ((8, 8), (5, 5)):
        points = wall(np.linspace(0, 2, count))
        settings = None if least == 8 else Settings(min_points=least)
        (segment,), asked = search(monkeypatch, points, settings=settings)
        assert len(asked) == 1
        assert segment.inliers.tolist() == [100 + i for i in range(count)]
        assert segment.line == pytest.approx(FLAT)
        found, asked = search(monkeypatch, points[1:], settings=settings)
        assert (found, asked) == ([], [])


def test_two_walls_are_found_the_larger_one_first(monkeypatch):
    points = np.vstack([wall(np.linspace(0, 2, 9), 5.0), wall(np.linspace(0, 3, 14), 1.0)])
    found, _ = search(monkeypatch, points)
    assert [segment.line.r for segment in found] == pytest.approx([1.0, 5.0])
    assert [len(segment.inliers) for segment in found] == [14, 9]


def test_the_search_ends_where_no_line_or_too_few_points_are_found(monkeypatch):
    points = wall(np.linspace(0, 2, 20))
    few = Consensus(FLAT, np.arange(7), 200)
    whole = Consensus(FLAT, np.arange(20), 200)
    for first in (None, few):
        found, asked = search(monkeypatch, points, [first, whole])
        assert (found, len(asked)) == ([], 1)
    (segment,), asked = search(monkeypatch, points, [whole])
    assert (len(segment.inliers), len(asked)) == (20, 1)


@pytest.mark.parametrize(("gap", "parts"), [(1.0, [20]), (1.25, [12, 8])])
def test_a_line_is_cut_at_a_gap_of_more_than_a_metre(monkeypatch, gap, parts):
    xs = np.arange(20) * 0.25  # exact, and so are the gaps
    xs[12:] += gap - 0.25
    points = wall(xs)
    points[:] = points[np.random.default_rng(2).permutation(20)]
    monkeypatch.setattr(walls, "positions_along", lambda points, line: points[:, 0])
    found, _ = search(monkeypatch, points)
    assert [len(segment.inliers) for segment in found] == parts
    assert all((np.diff(segment.inliers) > 0).all() for segment in found)
    wide, _ = search(monkeypatch, points, max_gap=1.25)
    assert [len(segment.inliers) for segment in wide] == [20]


def test_a_part_that_is_too_small_is_no_wall_and_taken_away(monkeypatch):
    points = wall(np.r_[np.linspace(0, 2, 7), np.linspace(9, 11, 6), np.linspace(20, 22, 5)])
    found, asked = search(monkeypatch, points)
    assert found == []
    assert [len(given[0]) for given in asked] == [18, 11]


def test_the_longest_part_is_cut_out_where_it_begins_and_ends():
    points = wall(np.r_[np.arange(3), 10 + np.arange(5), 30 + np.arange(4)] * 0.5)
    inliers = np.array([11, 3, 0, 7, 5, 4, 1, 6, 9, 10])
    assert walls._longest_part(points, FLAT, inliers, 1.0).tolist() == [3, 4, 5, 6, 7]
