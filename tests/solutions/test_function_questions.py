"""The cases of every function question tell the reference and all its mistakes apart."""

import inspect
import itertools
import math
from collections.abc import Callable

import numpy as np
import pytest

from autograder.exchange.wire import encode
from autograder.kinds.function.inside.evaluate import evaluate
from autograder.kinds.function.marking import agrees
from solutions.cases import line_fitting as line_cases
from solutions.cases import ransac as ransac_cases
from solutions.cases.planes_and_walls import find_walls_cases
from solutions.lines import line_fitting
from solutions.mistakes import line_fitting as line_mistakes
from solutions.mistakes import ransac as ransac_mistakes
from solutions.ransac import line as ransac_loop
from solutions.ransac import probabilities as ransac_probabilities
from solutions.ransac.fast import consensus as ransac

QUESTIONS: dict[str, tuple[Callable, Callable, Callable, list[Callable]]] = {
    "fit_line": (
        line_fitting.fit_line,
        line_cases.fit_line_cases,
        line_cases.same_line,
        [
            line_mistakes.keeps_negative_radius,
            line_mistakes.flips_only_the_radius,
            line_mistakes.leaves_alpha_unwrapped,
            line_mistakes.plain_arctan,
            line_mistakes.does_not_center,
            line_mistakes.regresses_y_on_x,
            line_mistakes.ignores_weights,
            line_mistakes.subtracts_large_squares,
        ],
    ),
    "required_iterations": (
        ransac_probabilities.required_iterations,
        ransac_cases.required_iterations_cases,
        ransac_cases.same_count,
        [
            ransac_mistakes.rounds_down,
            ransac_mistakes.does_not_round,
            ransac_mistakes.needs_one_inlier,
            ransac_mistakes.takes_p_for_failure,
            ransac_mistakes.always_pairs,
            ransac_mistakes.rejects_one_outlier,
            ransac_mistakes.loses_tiny_probabilities,
            ransac_mistakes.forgets_the_edges,
            ransac_mistakes.bare_formula,
            ransac_mistakes.bare_formula_rounded_down,
            ransac_mistakes.zero_at_the_edges,
            ransac_mistakes.checks_no_range,
        ],
    ),
    "ransac_line": (
        ransac_loop.ransac_line,
        ransac_cases.ransac_line_cases,
        ransac_cases.same_consensus,
        [
            ransac_mistakes.keeps_the_sample_line,
            ransac_mistakes.keeps_the_last_hypothesis,
            ransac_mistakes.forgets_the_absolute_value,
            ransac_mistakes.fits_all_points,
            ransac_mistakes.returns_the_outliers,
            ransac_mistakes.compares_the_square,
            ransac_mistakes.halves_the_band,
            ransac_mistakes.fixes_the_threshold,
            ransac_mistakes.fixes_both_numbers,
            ransac_mistakes.fixes_few_iterations,
            ransac_mistakes.fixes_many_iterations,
            ransac_mistakes.makes_its_own_generator,
            ransac_mistakes.returns_something_without_a_line,
        ],
    ),
    "line_covariance": (
        line_fitting.line_covariance,
        line_cases.line_covariance_cases,
        line_cases.same_covariance,
        [
            line_mistakes.covariance_with_the_wrong_sign,
            line_mistakes.covariance_with_a_certain_mean,
            line_mistakes.covariance_without_the_lever,
            line_mistakes.covariance_of_sigma,
            line_mistakes.covariance_of_raw_positions,
        ],
    ),
}


def results(function: Callable, cases: list[dict]) -> list[dict]:
    """What a function returns, raises, draws and changes, as the grader sees it."""
    with np.errstate(all="ignore"):
        return evaluate(function, {"kind": "function", "cases": cases})["outcomes"]


def agree(compare: Callable, cases: list[dict], one: list[dict], other: list[dict]) -> bool:
    """Whether a response with the outcomes `other` is taken for one with the outcomes `one`."""
    return all(agrees(compare, *trio) for trio in zip(cases, one, other, strict=True))


@pytest.mark.parametrize("question", QUESTIONS)
@pytest.mark.parametrize("seed", range(8))
def test_the_cases_tell_all_implementations_apart(question, seed):
    reference, make_cases, compare, mistakes = QUESTIONS[question]
    cases = make_cases(np.random.default_rng(seed))
    given = {function.__name__: results(function, cases) for function in (reference, *mistakes)}
    for name, values in given.items():
        assert agree(compare, cases, values, values), f"{name} is not recognised as itself"
    for one, other in itertools.combinations(given, 2):
        same = agree(compare, cases, given[one], given[other])
        assert not same, f"{one} and {other} agree on all cases"


@pytest.mark.parametrize("question", QUESTIONS)
def test_a_reference_needs_only_its_source_and_the_chapter(question):
    reference, make_cases, compare, _ = QUESTIONS[question]
    given = {"np": np, "math": math, "Line": line_fitting.Line}
    given |= {"fit_line": line_fitting.fit_line, "distances": line_fitting.distances}
    exec(inspect.getsource(reference), given)  # what the solved notebook does
    cases = make_cases(np.random.default_rng(0))
    here, there = results(reference, cases), results(given[reference.__name__], cases)
    assert agree(compare, cases, here, there)


@pytest.mark.parametrize("question", QUESTIONS)
def test_some_cases_are_public_and_most_are_hidden(question):
    cases = QUESTIONS[question][1](np.random.default_rng(0))
    public = [case for case in cases if case.get("public")]
    assert 0 < len(public) < len(cases) / 2


@pytest.mark.parametrize("question", QUESTIONS)
def test_another_seed_gives_other_hidden_inputs(question):
    one, other = (QUESTIONS[question][1](np.random.default_rng(seed)) for seed in (0, 1))
    pairs = list(zip(one, other, strict=True))
    same = [encode(first["args"]) == encode(second["args"]) for first, second in pairs]
    public = [bool(first.get("public")) for first, _ in pairs]
    assert all(equal for equal, shown in zip(same, public, strict=True) if shown)
    # Edges, such as no inliers at all, are the same in every draw.
    drawn = [not equal for equal, shown in zip(same, public, strict=True) if not shown]
    assert sum(drawn) > len(drawn) / 2


@pytest.mark.parametrize("seed", range(10))
def test_a_right_ransac_is_right_whatever_its_random_numbers(seed):
    for case in ransac_cases.ransac_line_cases(np.random.default_rng(seed)):
        points, threshold, iterations, _ = case["args"]
        if case["name"] in ("no iterations", "all points equal"):
            continue
        expected = ransac_loop.ransac_line(points, threshold, iterations, np.random.default_rng(1))
        rng = np.random.default_rng(seed + 100)
        other = ransac.ransac_line(points, threshold, iterations, rng)
        assert ransac_cases.same_consensus(case, expected, (other.model, other.inliers))


def chances(points: np.ndarray, threshold: float, fewest: int = 2) -> tuple[np.ndarray, float]:
    """The largest consensus set and the chance that a pair has it, by trying all pairs.

    With `fewest` points or more it must be the only one of its size.
    """
    one, other = np.triu_indices(len(points), 1)
    along = points[other] - points[one]
    lengths = np.hypot(*along.T)
    normals = np.column_stack([-along[:, 1], along[:, 0]])
    offsets = normals @ points.T - (normals * points[one]).sum(axis=1)[:, None]
    agreeing = (np.abs(offsets) <= threshold * lengths[:, None]) & (lengths > 0)[:, None]
    counts = agreeing.sum(axis=1)
    largest = agreeing[counts == counts.max()]
    assert counts.max() < fewest or (largest == largest[0]).all(), (
        "two different consensus sets are the largest"
    )
    return largest[0], float(np.mean(counts == counts.max()))


@pytest.mark.parametrize("seed", range(25))
def test_one_consensus_set_is_the_largest_and_is_missed_less_than_once_in_ten_million(seed):
    for case in ransac_cases.ransac_line_cases(np.random.default_rng(seed)):
        points, threshold, iterations, _ = case["args"]
        if case["name"] not in ("no iterations", "all points equal"):
            _, chance = chances(points, threshold)
            assert (1 - chance) ** iterations < 1e-7, case["name"]


@pytest.mark.parametrize("seed", range(25))
def test_in_every_room_one_wall_after_the_other_is_the_largest(seed):
    for case in find_walls_cases(np.random.default_rng(seed)):
        points, threshold, iterations, min_points, _ = case["args"]
        if iterations == 0:
            continue
        while len(points) >= min_points:
            wall, chance = chances(points, threshold, min_points)
            if wall.sum() < min_points:
                break
            assert (1 - chance) ** iterations < 1e-7, case["name"]
            points = points[~wall]


@pytest.mark.parametrize(
    "rubbish",
    [None, "line", 3.0, (1.0,), (1.0, 2.0, 3.0), (math.nan, 0.0), ("a", "b"), (10**400, 0), {}],
)
def test_rubbish_is_never_the_same_line(rubbish):
    case = {"args": [np.array([[0.0, 1.0], [1.0, 2.0]])]}
    assert not line_cases.same_line(case, (1.0, 0.5), rubbish)


@pytest.mark.parametrize(
    "rubbish",
    [None, "ab", ((1.0, 2.0),), ((math.nan, 0.0), [0]), ((1.0, 2.0), "x"), ((1, 2), [[0], [0, 1]])],
)
def test_rubbish_is_never_the_same_consensus(rubbish):
    case = {"args": [np.eye(2), 0.1, 5, {"rng": 0}]}
    line = (math.sqrt(0.5), math.pi / 4)
    assert not ransac_cases.same_consensus(case, (line, np.array([0, 1])), rubbish)


HALF = {"args": [0.99, 0.5, 2]}


@pytest.mark.parametrize("rubbish", [None, "17", True, [17, 17], math.nan, 16.5, 18, 10**400])
def test_rubbish_is_never_the_same_count(rubbish):
    assert not ransac_cases.same_count(HALF, 17, rubbish)


def test_a_count_is_exact_unless_it_is_too_large_for_that():
    for same in (17, 17.0, np.float64(17), np.array(17)):
        assert ransac_cases.same_count(HALF, 17, same)
    assert ransac_cases.same_count(HALF, 10**14, 10**14 + 9)
    assert not ransac_cases.same_count(HALF, 10**14, 10**14 + 10**6)
    assert not ransac_cases.same_count(HALF, 10**8, 10**8 + 1)
    assert ransac_cases.same_count(HALF, math.inf, math.inf)
    assert not ransac_cases.same_count(HALF, math.inf, 10**300)


@pytest.mark.parametrize("rubbish", [None, "ab", 1.0, np.eye(3), np.full((2, 2), math.nan), {}])
def test_rubbish_is_never_the_same_covariance(rubbish):
    assert not line_cases.same_covariance({"args": []}, np.eye(2), rubbish)


def test_only_what_rounding_decides_is_forgiven():
    case = {"args": [np.array([[-2.0, 1.0], [-2.0, 2.0]])]}
    assert line_cases.same_line(case, (2.0, math.pi), (2.0, -math.pi + 1e-12))
    assert line_cases.same_line(case, (1e-12, 0.5), (0.0, 0.5 - math.pi))
    assert not line_cases.same_line(case, (2.0, 0.5), (-2.0, 0.5 - math.pi))
    assert not line_cases.same_line(case, (2.0, -2.5), (2.0, -2.5 + 2 * math.pi))
