"""Functions: right on every kind of input, or like a known mistake, or right on some kinds."""

import functools
import math
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from autograder.kinds.function.marking import close
from autograder.marking import Mark
from autograder.marking.marker import Marker
from autograder.sandbox.inside.evaluate import evaluate


@pytest.fixture
def marker(toy) -> Marker:
    """Q1.5 asks for the mean of some weights: none, two equal, many, one heavy."""
    return Marker(toy.load(), seed=5)


def mark(marker: Marker, function: Any) -> Mark:
    """Marked as the grader does it: run over there, compared here."""
    return marker.mark("Q1.5", evaluate(function, marker.drawn("Q1.5").probe))


def test_another_way_to_the_right_values_is_right(marker):
    verdict = mark(marker, lambda weights: float(np.mean(weights)) if weights else 0)
    assert (verdict.status, verdict.credit, verdict.points) == ("right", 1, 4)
    assert verdict.alternative == "right"
    assert [part.label for part in verdict.parts] == [
        "no weights", "two equal weights", "many weights", "one heavy weight",
    ]  # fmt: skip


@pytest.mark.parametrize(
    "number",
    [np.float64, np.longdouble, Fraction, sp.Float, lambda mean: np.array(mean)],
    ids=["float64", "longdouble", "Fraction", "sympy", "array"],
)
def test_a_right_value_of_any_type_is_right(marker, number):
    def mean(weights):
        return number(sum(weights) / max(len(weights), 1))

    assert mark(marker, mean).status == "right"


def test_a_stub_is_not_attempted(marker):
    def stub(weights):
        raise NotImplementedError

    def counted(weights):
        return stub(weights)

    for function in (..., stub, functools.wraps(stub)(counted)):
        assert mark(marker, function).status == "not attempted"


def test_what_is_written_was_attempted_even_if_some_inputs_are_still_refused(marker):
    def mean(weights):
        if not weights:
            raise NotImplementedError
        return sum(weights) / len(weights)

    verdict = mark(marker, mean)
    assert (verdict.status, verdict.credit) == ("partial", 0.5)
    assert "no weights (it raises NotImplementedError)" in verdict.feedback


def test_a_function_that_calls_the_stub_of_another_question_was_attempted(marker):
    """It is no response of its own, and "nothing was answered" would be false."""

    def total(weights):
        raise NotImplementedError

    def mean(weights):
        return total(weights) / max(1, len(weights))

    reply = evaluate(mean, marker.drawn("Q1.5").probe | {"tell": True})
    assert reply["told"]["message"] == "total is not written yet"
    verdict = marker.mark("Q1.5", reply)
    assert (verdict.status, verdict.credit) == ("error", 0)
    assert "NotImplementedError on every input" in verdict.feedback


@pytest.mark.parametrize("seed", range(5))
def test_a_known_mistake_is_recognised_in_other_words(toy, seed):
    marker = Marker(toy.load(), seed)

    def loop_sum(weights):
        total = 0
        for weight in weights:
            total = total + weight
        return total

    verdict = mark(marker, loop_sum)
    assert (verdict.status, verdict.credit, verdict.alternative) == ("partial", 0.25, "the sum")
    assert verdict.feedback == "You return the sum; divide it by the number of weights."
    # Right for no weights at all, wrong for the others.
    assert [part.right for part in verdict.parts] == [True, False, False, False]


def test_what_is_right_on_some_kinds_earns_their_share(marker):
    def right_but_for_three(weights):
        return -1 if len(weights) == 3 else sum(weights) / max(len(weights), 1)

    verdict = mark(marker, right_but_for_three)
    # "two equal weights" is public, and 0 for "no weights" is what any function may return: one of
    # the two others is right.
    assert (verdict.status, verdict.credit) == ("partial", 0.5)
    assert verdict.feedback == "Right on 3 of 4 kinds of input. Not yet on: one heavy weight."
    assert verdict.alternative is None


@pytest.mark.parametrize("value", [0, 0.0, None, [], False])
def test_what_returns_the_same_whatever_comes_earns_nothing(marker, value):
    assert mark(marker, lambda weights: value).credit == 0


def test_a_function_that_fails_the_public_example_earns_half_at_most(marker):
    wrong_in_public = mark(marker, lambda w: np.mean(w) if len(w) > 2 else 0.0)
    assert wrong_in_public.credit == 0.5


@pytest.mark.parametrize(
    ("function", "name"),
    [
        (lambda w: -np.mean(w) if w else 0.0, "sign turned"),
        (lambda w: 2 * np.mean(w) if w else 0.0, "twice"),
        (lambda w: float(np.degrees(np.mean(w))) if w else 0.0, "degrees"),
        (lambda w: np.mean(w) + 1 if w else 1.0, "one more"),
        (lambda w: None, "returns nothing"),
        (lambda w: list(w), "returns its input"),
    ],
)
def test_a_wrong_function_gets_the_name_of_its_relation_to_the_right_one(marker, function, name):
    verdict = mark(marker, function)
    assert verdict.alternative == name
    assert verdict.feedback.startswith("It looks as if ")
    assert verdict.status != "right"


def test_a_relation_that_holds_on_some_cases_only_names_nothing(marker):
    def twice_but_once(weights):
        return (2 if len(weights) != 3 else 3) * np.mean(weights) if weights else 0.0

    assert mark(marker, twice_but_once).alternative is None


def test_right_values_from_an_input_changed_in_place_are_named(marker):
    def sorts(weights):
        mean = float(np.mean(weights)) if weights else 0.0
        weights.append(1.0)
        return mean

    verdict = mark(marker, sorts)
    assert (verdict.alternative, verdict.credit) == ("changes its input", 0)


def test_the_public_result_by_heart_earns_nothing(marker):
    verdict = mark(marker, lambda weights: 3.0 if list(weights) == [3.0, 3.0] else -1.0)
    assert [part.right for part in verdict.parts] == [False, True, False, False]
    assert (verdict.status, verdict.credit) == ("wrong", 0)


def test_what_is_wrong_everywhere_earns_nothing(marker):
    verdict = mark(marker, lambda weights: -5.0)
    assert (verdict.status, verdict.credit) == ("wrong", 0)


def test_an_exception_on_some_kinds_costs_these_and_names_only_pythons_own_classes(marker):
    class Secret(Exception):
        pass

    def fails(weights):
        if not weights:
            raise ZeroDivisionError("hidden")
        if len(weights) > 4:
            raise Secret
        return sum(weights) / len(weights)

    verdict = mark(marker, fails)
    assert (verdict.status, verdict.credit) == ("partial", 0.33)
    assert "no weights (it raises ZeroDivisionError)" in verdict.feedback
    assert "many weights (it raises Exception)" in verdict.feedback
    assert "hidden" not in verdict.feedback
    assert "Secret" not in verdict.feedback


def test_an_exception_on_every_input_is_an_error(marker):
    def fails(weights):
        return weights.mean()

    verdict = mark(marker, fails)
    assert (verdict.status, verdict.credit) == ("error", 0)
    assert "AttributeError on every input" in verdict.feedback


def test_a_class_that_only_bears_a_python_name_is_not_repeated(marker):
    impostor = type("ValueError", (Exception,), {})

    def fails(weights):
        raise impostor

    assert "ValueError" not in mark(marker, fails).feedback


def test_something_that_is_no_function_is_wrong_and_told_so(marker):
    for response in (3.0, "mean", [lambda weights: 1]):
        verdict = mark(marker, response)
        assert (verdict.status, verdict.alternative) == ("wrong", "not usable")
        assert "it is not a function" in verdict.feedback


def test_a_wrong_number_of_parameters_is_an_error(marker):
    verdict = mark(marker, lambda: 3.0)
    assert verdict.status == "error"
    assert "TypeError" in verdict.feedback


def test_a_returned_value_that_is_not_plain_is_wrong_and_told_so(marker):
    verdict = mark(marker, lambda weights: object())
    assert (verdict.status, verdict.credit) == ("wrong", 0)
    assert "returned something that is not a number" in verdict.feedback


def test_arguments_are_fresh_in_every_case(marker):
    def spoils(weights):
        result = sum(weights) / len(weights) if weights else 0.0
        weights.clear()
        return result

    sent = marker.drawn("Q1.5").probe
    before = [list(case["args"][0]) for case in sent["cases"]]
    verdict = mark(marker, spoils)
    assert verdict.parts[0].right  # no weights: nothing to change
    assert all("changes its input" in part.feedback for part in verdict.parts[1:])
    assert [case["args"][0] for case in sent["cases"]] == before


def test_no_feedback_contains_a_hidden_input(marker):
    hidden = [
        str(value) for case in marker.drawn("Q1.5").probe["cases"] for value in case["args"][0]
    ]
    for function in (lambda weights: -5.0, lambda weights: weights, lambda weights: str(weights)):
        verdict = mark(marker, function)
        text = verdict.feedback + "".join(part.feedback + part.label for part in verdict.parts)
        assert not any(value in text for value in hidden if len(value) > 4)


def test_the_same_seed_draws_the_same_inputs_and_another_seed_others(toy):
    course = toy.load()
    draws = [Marker(course, seed).drawn("Q1.5").probe["cases"] for seed in (3, 3, 4)]
    assert draws[0] == draws[1]
    assert draws[0] != draws[2]


# The default comparison.

plain = st.recursive(
    st.none()
    | st.booleans()
    | st.integers()
    | st.floats()
    | st.complex_numbers(allow_nan=False)
    | st.text(max_size=4)
    | hnp.arrays(
        st.sampled_from([np.float64, np.int64, np.bool_, np.complex128]),
        hnp.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=3),
    ),
    lambda inner: (
        st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=3), inner, max_size=3)
    ),
    max_leaves=8,
)


@given(plain)
def test_everything_plain_is_close_to_itself(value):
    assert close({}, value, value)


@given(plain, plain)
def test_comparing_any_two_plain_values_never_calls_different_kinds_close(one, other):
    kinds = {type(one), type(other)}
    agreed = close({}, one, other)
    if kinds in ({str, list}, {dict, list}, {str, float}, {type(None), float}, {dict, np.ndarray}):
        assert not agreed


@given(st.floats(-1e6, 1e6), st.floats(-1, 1))
def test_numbers_agree_to_six_digits(value, off):
    if abs(value) > 1e-3 and abs(abs(off) - 0.1) > 0.05:
        assert close({}, value, value * (1 + off * 1e-5)) == (abs(off) < 0.1)


@pytest.mark.parametrize(
    ("expected", "actual", "agrees"),
    [
        (1, 1.0, True),
        (1.0, 1, True),
        (0.0, 1e-15, True),
        (0.0, 1e-3, False),
        (math.inf, math.inf, True),
        (math.inf, -math.inf, False),
        (math.inf, 1e308, False),
        (math.nan, math.nan, True),
        (math.nan, 0.0, False),
        (True, True, True),
        (True, 1, False),
        (None, None, True),
        (None, False, False),
        ("a", "a", True),
        ("a", "b", False),
        ("1", 1, False),
        (2**100, 2**100, True),
        (2**100, 2**100 + 1, False),
        (10**30, 1e30, True),
        ([1, 2], [1, 2], True),
        ([1, 2], np.array([1, 2]), True),
        (np.array([1.0, 2.0]), [1.0, 2.0], True),
        ([1, 2], [1, 2, 3], False),
        ([1, 2], [2, 1], False),
        ([[1, 2]], [1, 2], False),
        (np.zeros((2, 3)), np.zeros((3, 2)), False),
        (np.zeros(3), 0.0, False),
        (np.array([1e6, 1e-12]), np.array([1e6, 0.0]), True),
        (["a", 1.0], ["a", 1.0 + 1e-9], True),
        (["a", 1.0], ["a", 1.1], False),
        ([[1], [2, 3]], [[1], [2, 3]], True),
        ([[1], [2, 3]], [[1], [2, 4]], False),
        ([], [], True),
        ([], None, False),
        ({"r": 2.0, "alpha": [0.5]}, {"alpha": [0.5], "r": 2.0}, True),
        ({"r": 2.0}, {"r": 2.0, "alpha": 0.5}, False),
        ({"r": 2.0}, [2.0], False),
        (1 + 2j, 1 + 2j, True),
        (1 + 2j, 1 - 2j, False),
        (1.0, 1.0 + 0j, True),
        (10**9, float(10**9 + 1), False),
        (np.array([10**9, 2]), np.array([10.0**9 + 1, 2.0]), False),
        ([3, 4], [3.0, 4.0 + 1e-9], True),
        (10**30, 10**30 + 1, False),
        (np.array([2**60, 1]), np.array([2**60, 1]), True),
        (np.array([2**60, 1]), np.array([2**60 + 1, 1]), False),
    ],
)
def test_the_default_comparison_by_example(expected, actual, agrees):
    assert close({}, expected, actual) == agrees
