"""Splitting and merging many runs at once, against doing it to one run after the other."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from solutions.lines.fast.scan_runs import RunSums, merge_runs, split_runs
from solutions.lines.line_extraction import split
from solutions.lines.line_fitting import distances, fit_line


class Echoes:
    """Random points of three scans of 40 beams, of which some have no echo."""

    def __init__(self, seed: int = 0) -> None:
        rng = np.random.default_rng(seed)
        seen = rng.uniform(size=(3, 40)) < 0.8
        coordinates = np.where(seen, np.cumsum(rng.normal(size=(2, 3, 40)), axis=2), 0.0)
        self.scan, self.beam = np.nonzero(seen)
        self.points = coordinates[:, seen].T
        self.sums = RunSums(*coordinates, self.scan, self.beam)
        ends = np.flatnonzero(np.diff(self.scan))
        self.first, self.last = np.append(0, ends + 1), np.append(ends, len(self.scan) - 1)


def sums_of(points: np.ndarray) -> RunSums:
    """The sums of one scan in which each beam has an echo."""
    beams = np.arange(len(points))
    return RunSums(*points.T[:, None], np.zeros_like(beams), beams)


def test_the_sums_over_a_run_are_those_of_its_points():
    echoes = Echoes()
    runs = [(0, 0), (3, 4), (2, 20)]
    for scan_first, scan_last in zip(echoes.first, echoes.last, strict=True):
        runs += [(scan_first, scan_last), (scan_first + 1, scan_last - 2), (scan_last, scan_last)]
    first, last = np.array(runs).T
    found = np.column_stack(echoes.sums.moments(first, last))
    rough = echoes.sums.roughness(first, last)
    for (start, end), row, roughness in zip(runs, found, rough, strict=True):
        points = echoes.points[start : end + 1]
        (S_xx, S_xy), (_, S_yy) = np.cov(points.T, bias=True) * len(points)
        assert row == pytest.approx([len(points), *points.mean(axis=0), S_xx, S_xy, S_yy])
        if len(points) > 2:
            away = distances(points, fit_line(points))
            assert roughness == pytest.approx(np.sqrt(np.mean(away**2)))
        else:
            assert roughness == pytest.approx(0.0, abs=1e-6)


def test_a_straight_run_is_smooth_even_where_rounding_makes_its_squares_negative():
    along = np.linspace(30.0, 40.0, 100)
    for slope in np.linspace(0.1, 3.0, 50):
        sums = sums_of(np.column_stack([along, slope * along]))
        assert sums.roughness(np.array([0]), np.array([99]))[0] == pytest.approx(0.0, abs=1e-5)


@pytest.mark.parametrize("distance", [0.0, 0.3, 1.0, 3.0, 100.0])
def test_many_runs_are_split_as_each_by_itself(distance):
    echoes = Echoes(1)
    points = echoes.points
    # A pair, one point and three of them are runs as well.
    first = np.r_[0, 2, 3, 6, echoes.first[1:]]
    last = np.r_[first[1:] - 1, echoes.last[-1]]
    expected = [
        (int(start) + piece[0], int(start) + piece[1], run)
        for run, (start, end) in enumerate(zip(first, last, strict=True))
        for piece in split(points[start : end + 1], distance)
    ]
    found = split_runs(points, first, last, distance)
    assert np.column_stack(found).tolist() == [list(piece) for piece in expected]


def pieces_of(points: list[tuple[float, float]], distance: float) -> list[tuple[int, int]]:
    array = np.array(points, dtype=float)
    first, last, run = split_runs(array, np.array([0]), np.array([len(array) - 1]), distance)
    assert (run == 0).all()
    pieces = list(zip(first.tolist(), last.tolist(), strict=True))
    assert pieces == split(array, distance)
    return pieces


def test_a_run_is_split_behind_the_first_of_its_farthest_points():
    bump = [(0, 0), (1, 0), (2, 1), (3, 1), (4, 0), (5, 0)]
    assert pieces_of(bump, 0.5) == [(0, 2), (3, 5)]
    assert pieces_of([(0, 0), (1, 1), (2, 0)], 1.0) == [(0, 2)]
    assert pieces_of([(0, 0), (1, 1), (2, 0)], 0.999) == [(0, 1), (2, 2)]
    with np.errstate(all="raise"):  # their chord has no direction
        assert pieces_of([(1, 1)] * 4, 0.1) == [(0, 3)]


def test_no_runs_have_no_pieces():
    none = np.zeros(0, dtype=int)
    assert [len(part) for part in split_runs(np.zeros((0, 2)), none, none, 0.1)] == [0, 0, 0]
    sums = sums_of(np.zeros((1, 2)))
    assert [len(part) for part in merge_runs(sums, none, none, none, 0.1)] == [0, 0, 0]


def cost(points: np.ndarray) -> float:
    return round(float(np.sqrt(np.mean(distances(points, fit_line(points)) ** 2))), 4)


def merged(points: np.ndarray, pieces: list[tuple[int, int, int]], roughness: float) -> list:
    """One pair after the other, the straightest first, and of equal ones the first."""
    pieces = list(pieces)
    while True:
        pairs = [
            (cost(points[one[0] : other[1] + 1]), i)
            for i, (one, other) in enumerate(pairwise(pieces))
            if one[2] == other[2]
        ]
        if not pairs or min(pairs)[0] > roughness:
            return pieces
        i = min(pairs)[1]
        pieces[i : i + 2] = [(pieces[i][0], pieces[i + 1][1], pieces[i][2])]


@pytest.mark.parametrize("roughness", [0.0, 0.2, 0.5, 1.0, 100.0])
@pytest.mark.parametrize("distance", [0.2, 0.8])
def test_many_runs_are_merged_as_each_by_itself(roughness, distance):
    echoes = Echoes(2)
    first = np.r_[0, 5, echoes.first[1:], echoes.last[-1]]
    last = np.r_[first[1:] - 1, echoes.last[-1]]
    pieces = split_runs(echoes.points, first, last, distance)
    listed = [tuple(piece) for piece in np.column_stack(pieces).tolist()]
    found = merge_runs(echoes.sums, *pieces, roughness)
    expected = merged(echoes.points, listed, roughness)
    assert np.column_stack(found).tolist() == [list(piece) for piece in expected]


@pytest.mark.parametrize(
    ("height", "roughness", "joined"),
    [
        (0.25, 0.25, True),
        (0.25, 0.2499, False),
        (0.25004, 0.25, True),  # to 0.1 mm
        (0.2504, 0.2503, False),
        (0.2504, 0.2504, True),
    ],
)
def test_two_pieces_are_joined_up_to_exactly_the_roughness(height, roughness, joined):
    """Points as far above as below a line: joined, that is their roughness."""
    points = np.column_stack([[0.0, 8.0, 16.0, 24.0], np.array([1, -1, -1, 1]) * height])
    pieces = np.array([0, 2]), np.array([1, 3]), np.array([0, 0])
    found = merge_runs(sums_of(points), *pieces, roughness)
    assert found[1].tolist() == ([3] if joined else [1, 3])


def test_of_pairs_that_cost_the_same_the_first_is_joined():
    """Three single points: any two of them are straight, and all three are not."""
    for turn in np.linspace(0.0, 6.0, 20):
        points = np.array([[1.0, 2.0], [2.0, 3.0], [1.1, 4.0]]) + np.cos([turn, turn - 1])
        single = np.arange(3)
        found = merge_runs(sums_of(points), single, single.copy(), np.zeros(3, dtype=int), 0.01)
        assert [part.tolist() for part in found[:2]] == [[0, 2], [1, 2]]
