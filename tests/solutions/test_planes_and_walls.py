"""The cases of `ransac_plane` and `find_walls` tell the references and all mistakes apart."""

import itertools
import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from autograder.kinds.function.inside.evaluate import evaluate
from autograder.kinds.function.marking import agrees
from solutions.cases import planes_and_walls as cases
from solutions.mistakes import planes_and_walls as mistakes
from solutions.ransac.fast.consensus import ransac_plane as ransac_plane_at_once
from solutions.ransac.plane import ransac_plane
from solutions.ransac.walls import find_walls

QUESTIONS: dict[str, tuple[Callable, Callable, Callable, list[Callable]]] = {
    "ransac_plane": (
        ransac_plane,
        cases.ransac_plane_cases,
        cases.same_plane,
        [
            mistakes.forgets_to_normalise,
            mistakes.keeps_the_sample_plane,
            mistakes.counts_one_side,
            mistakes.fits_all_points,
            mistakes.compares_the_square,
            mistakes.halves_the_band,
            mistakes.fixes_the_threshold,
            mistakes.fixes_both_numbers,
            mistakes.fixes_few_iterations,
            mistakes.fixes_many_iterations,
            mistakes.makes_its_own_generator,
            mistakes.returns_something_without_a_plane,
            mistakes.takes_any_plane_through_a_line,
        ],
    ),
    "find_walls": (
        find_walls,
        cases.find_walls_cases,
        cases.same_walls,
        [
            mistakes.counts_among_the_rest,
            mistakes.stops_after_one_wall,
            mistakes.keeps_small_walls,
            mistakes.leaves_the_points_in,
            mistakes.wants_more_than_min_points,
            mistakes.fixes_min_points,
            mistakes.shares_points_between_walls,
            mistakes.fixes_the_wall_threshold,
            mistakes.draws_few_samples_for_walls,
            mistakes.draws_many_samples_for_walls,
        ],
    ),
}


def results(function: Callable, given: list[dict], seed: int = 0) -> list[dict]:
    """What a function returns, raises, draws and changes, as the grader sees it."""

    def other(value: Any) -> Any:
        return {"rng": value["rng"] + seed} if isinstance(value, dict) else value

    sent = [{"args": [other(value) for value in case["args"]]} for case in given]
    with np.errstate(all="ignore"):
        return evaluate(function, {"kind": "function", "cases": sent})["outcomes"]


def agree(compare: Callable, cases: list[dict], one: list[dict], other: list[dict]) -> bool:
    """Whether a response with the outcomes `other` is taken for one with the outcomes `one`."""
    return all(agrees(compare, *trio) for trio in zip(cases, one, other, strict=True))


@pytest.mark.parametrize("question", QUESTIONS)
@pytest.mark.parametrize("seed", range(4))
def test_the_cases_tell_all_implementations_apart(question, seed):
    reference, make_cases, compare, wrong = QUESTIONS[question]
    given = make_cases(np.random.default_rng(seed))
    found = {function: results(function, given) for function in (reference, *wrong)}
    for one, other in itertools.combinations(found, 2):
        same = agree(compare, given, found[one], found[other])
        assert not same, f"{one.__name__} and {other.__name__} agree on all cases"


@pytest.mark.parametrize("question", QUESTIONS)
@pytest.mark.parametrize("seed", range(12))
def test_a_right_implementation_is_right_whatever_its_random_numbers(question, seed):
    reference, make_cases, compare, _ = QUESTIONS[question]
    given = make_cases(np.random.default_rng(seed))
    assert agree(compare, given, results(reference, given), results(reference, given, seed=7))


@pytest.mark.parametrize("seed", range(6))
def test_the_largest_plane_is_missed_less_than_once_in_ten_million(seed):
    for case in cases.ransac_plane_cases(np.random.default_rng(seed)):
        points, threshold, iterations, _ = case["args"]
        if case["name"] not in ("no iterations", "all points on one line"):
            chance = chance_of_the_largest(np.asarray(points), threshold)
            assert (1 - chance) ** iterations < 1e-7, case["name"]


def chance_of_the_largest(points: np.ndarray, threshold: float) -> float:
    """The share of the triples of points, or of many, whose plane has the most points."""
    if math.comb(len(points), 3) < 100_000:
        triples = np.array(list(itertools.combinations(range(len(points)), 3)))
    else:
        shuffled = np.random.default_rng(0).random((20_000, len(points)))
        triples = np.argpartition(shuffled, 3, axis=1)[:, :3]
    first, second, third = points[triples].transpose(1, 0, 2)
    normals = np.cross(second - first, third - first)
    lengths = np.linalg.norm(normals, axis=1)
    offsets = normals @ points.T - (normals * first).sum(axis=1)[:, None]
    counts = (np.abs(offsets) <= threshold * lengths[:, None]).sum(axis=1)
    counts[lengths == 0] = 0
    return float(np.mean(counts == counts.max()))


def test_another_implementation_of_ransac_passes_as_well():
    given = cases.ransac_plane_cases(np.random.default_rng(9))
    for case, expected in zip(given, results(ransac_plane, given), strict=True):
        if "raised" in expected:
            continue
        points, threshold, iterations, _ = case["args"]
        other = ransac_plane_at_once(points, threshold, iterations, np.random.default_rng(3))
        assert cases.same_plane(case, expected["value"], (other.model, other.inliers))


def test_a_floor_at_a_known_height_is_found():
    # A floor at a known height: z = 1 with noise of a centimetre, and a few points above it.
    rng = np.random.default_rng(5)
    floor = np.column_stack([rng.uniform(-2, 2, (200, 2)), 1 + rng.normal(0, 0.01, 200)])
    points = np.vstack([floor, rng.uniform([-2, -2, 1.5], [2, 2, 3], (100, 3))])
    plane, inliers = ransac_plane(points, 0.04, 100, rng)
    assert plane.r == pytest.approx(1.0, abs=0.01)
    assert plane.normal[2] == pytest.approx(1.0, abs=1e-3)
    assert set(inliers) == set(range(200))


@pytest.mark.parametrize("rubbish", [None, 3, "walls", [1, 2], [(None, None)], [((1, 2), "a")]])
def test_rubbish_is_never_right(rubbish):
    case = cases.find_walls_cases(np.random.default_rng(0))[0]
    assert not cases.same_walls(case, results(find_walls, [case])[0]["value"], rubbish)
    case = cases.ransac_plane_cases(np.random.default_rng(0))[0]
    assert not cases.same_plane(case, results(ransac_plane, [case])[0]["value"], rubbish)


def test_a_search_ends_where_the_rest_has_no_line():
    wall = np.column_stack([np.full(20, 2.0), np.linspace(-1, 1, 20)])
    points = np.vstack([wall, np.tile([[0.0, 0.5]], (15, 1)), [[0.1, 0.5]]])
    # Of 120 pairs in the rest 15 have two different points: a single draw may well have none.
    for seed in range(20):
        walls = find_walls(points, 0.01, 8, 18, np.random.default_rng(seed))
        assert all(set(indices) == set(range(20)) for _, indices in walls)
    assert find_walls(np.tile([[1.0, 2.0]], (9, 1)), 0.1, 20, 3, np.random.default_rng(0)) == []
    assert find_walls(np.zeros((0, 2)), 0.1, 20, 3, np.random.default_rng(0)) == []
