"""The cases of `ransac_plane` and `find_walls` tell the references and all mistakes apart."""

import itertools
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

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
        ],
    ),
}


def results(function: Callable, given: list[dict], seed: int = 0) -> list[Any]:
    def argument(value: Any) -> Any:
        return np.random.default_rng(value["rng"] + seed) if isinstance(value, dict) else value

    return [function(*map(argument, case["args"])) for case in given]


@pytest.mark.parametrize("question", QUESTIONS)
@pytest.mark.parametrize("seed", range(4))
def test_the_cases_tell_all_implementations_apart(question, seed):
    reference, make_cases, compare, wrong = QUESTIONS[question]
    given = make_cases(np.random.default_rng(seed))
    found = {function: results(function, given) for function in (reference, *wrong)}
    for one, other in itertools.combinations(found, 2):
        same = all(map(compare, given, found[one], found[other]))
        assert not same, f"{one.__name__} and {other.__name__} agree on all cases"


@pytest.mark.parametrize("question", QUESTIONS)
@pytest.mark.parametrize("seed", range(4))
def test_a_right_implementation_is_right_whatever_its_random_numbers(question, seed):
    reference, make_cases, compare, _ = QUESTIONS[question]
    given = make_cases(np.random.default_rng(seed))
    pairs = zip(results(reference, given), results(reference, given, seed=7), strict=True)
    assert all(compare(case, *pair) for case, pair in zip(given, pairs, strict=True))


def test_another_implementation_of_ransac_passes_as_well():
    given = cases.ransac_plane_cases(np.random.default_rng(9))
    for case, expected in zip(given, results(ransac_plane, given), strict=True):
        points, threshold, iterations, _ = case["args"]
        other = ransac_plane_at_once(points, threshold, iterations, np.random.default_rng(3))
        assert cases.same_plane(case, expected, (other.model, other.inliers))


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
    assert not cases.same_walls(case, results(find_walls, [case])[0], rubbish)
    case = cases.ransac_plane_cases(np.random.default_rng(0))[0]
    assert not cases.same_plane(case, results(ransac_plane, [case])[0], rubbish)
