"""The cases of every function question tell the reference and all its mistakes apart."""

import inspect
import itertools
import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from solutions.cases import line_fitting as line_cases
from solutions.cases import ransac as ransac_cases
from solutions.lines import line_fitting
from solutions.mistakes import line_fitting as line_mistakes
from solutions.mistakes import ransac as ransac_mistakes
from solutions.ransac import line as ransac_loop
from solutions.ransac import probabilities as ransac_probabilities
from solutions.ransac.fast import consensus as ransac


def close(case: dict, expected: Any, actual: Any) -> bool:
    return math.isclose(expected, actual, rel_tol=1e-6)


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
            line_mistakes.does_not_centre,
            line_mistakes.regresses_y_on_x,
            line_mistakes.ignores_weights,
            line_mistakes.subtracts_large_squares,
        ],
    ),
    "required_iterations": (
        ransac_probabilities.required_iterations,
        ransac_cases.required_iterations_cases,
        close,
        [
            ransac_mistakes.rounds_down,
            ransac_mistakes.does_not_round,
            ransac_mistakes.needs_one_inlier,
            ransac_mistakes.takes_p_for_failure,
            ransac_mistakes.always_pairs,
            ransac_mistakes.rejects_one_outlier,
            ransac_mistakes.loses_tiny_probabilities,
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
        ],
    ),
    "line_covariance": (
        line_fitting.line_covariance,
        line_cases.line_covariance_cases,
        line_cases.same_covariance,
        [
            line_mistakes.covariance_with_the_wrong_sign,
            line_mistakes.covariance_without_the_lever,
            line_mistakes.covariance_of_sigma,
            line_mistakes.covariance_of_raw_positions,
        ],
    ),
}


def argument(value: Any) -> Any:
    return np.random.default_rng(value["rng"]) if isinstance(value, dict) else value


def results(function: Callable, cases: list[dict]) -> list[Any]:
    return [function(*map(argument, case["args"]), **case.get("kwargs", {})) for case in cases]


@pytest.mark.parametrize("question", QUESTIONS)
@pytest.mark.parametrize("seed", range(8))
def test_the_cases_tell_all_implementations_apart(question, seed):
    reference, make_cases, compare, mistakes = QUESTIONS[question]
    cases = make_cases(np.random.default_rng(seed))
    given = {function.__name__: results(function, cases) for function in (reference, *mistakes)}
    for name, values in given.items():
        assert all(map(compare, cases, values, values)), f"{name} is not recognised as itself"
    for one, other in itertools.combinations(given, 2):
        same = all(map(compare, cases, given[one], given[other]))
        assert not same, f"{one} and {other} agree on all cases"


@pytest.mark.parametrize("question", QUESTIONS)
def test_a_reference_needs_only_its_source_and_the_chapter(question):
    reference, make_cases, compare, _ = QUESTIONS[question]
    given = {"np": np, "math": math, "Line": line_fitting.Line}
    given |= {"fit_line": line_fitting.fit_line, "distances": line_fitting.distances}
    exec(inspect.getsource(reference), given)  # what the solved notebook does
    cases = make_cases(np.random.default_rng(0))
    pairs = zip(results(reference, cases), results(given[reference.__name__], cases), strict=True)
    assert all(compare(case, *pair) for case, pair in zip(cases, pairs, strict=True))


@pytest.mark.parametrize("question", QUESTIONS)
def test_some_cases_are_public_and_most_are_hidden(question):
    cases = QUESTIONS[question][1](np.random.default_rng(0))
    public = [case for case in cases if case.get("public")]
    assert 0 < len(public) < len(cases) / 2


@pytest.mark.parametrize("question", QUESTIONS)
def test_another_seed_gives_other_hidden_inputs(question):
    one, other = (QUESTIONS[question][1](np.random.default_rng(seed)) for seed in (0, 1))
    for first, second in zip(one, other, strict=True):
        same = np.array_equal(first["args"][0], second["args"][0])
        same = same and first["args"][1:] == second["args"][1:]
        assert same == bool(first.get("public"))


@pytest.mark.parametrize("seed", range(10))
def test_a_right_ransac_is_right_whatever_its_random_numbers(seed):
    cases = ransac_cases.ransac_line_cases(np.random.default_rng(seed))
    for case in cases:
        points, threshold, iterations, _ = case["args"]
        expected = ransac_loop.ransac_line(points, threshold, iterations, np.random.default_rng(1))
        rng = np.random.default_rng(seed + 100)
        other = ransac.ransac_line(points, threshold, iterations, rng)
        assert ransac_cases.same_consensus(case, expected, (other.model, other.inliers))


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
    assert not ransac_cases.same_consensus(case, ((1.0, 2.0), np.array([0, 1])), rubbish)


@pytest.mark.parametrize("rubbish", [None, "ab", 1.0, np.eye(3), np.full((2, 2), math.nan), {}])
def test_rubbish_is_never_the_same_covariance(rubbish):
    assert not line_cases.same_covariance({"args": []}, np.eye(2), rubbish)


def test_only_what_rounding_decides_is_forgiven():
    case = {"args": [np.array([[-2.0, 1.0], [-2.0, 2.0]])]}
    assert line_cases.same_line(case, (2.0, math.pi), (2.0, -math.pi + 1e-12))
    assert line_cases.same_line(case, (1e-12, 0.5), (0.0, 0.5 - math.pi))
    assert not line_cases.same_line(case, (2.0, 0.5), (-2.0, 0.5 - math.pi))
    assert not line_cases.same_line(case, (2.0, -2.5), (2.0, -2.5 + 2 * math.pi))
