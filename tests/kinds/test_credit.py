"""What a function earns that is right on some kinds of input and is no known mistake."""

import math
from typing import Any

import numpy as np
import pytest

from autograder.kinds.function.credit import _trivial, partial_credit
from autograder.kinds.function.marking import agrees, close


def credit(
    kinds: str, right: list[Any], verdicts: str, public: str = "", most: float = 1.0, **case: Any
) -> float:
    """The credit of a function whose cases have one letter each for their kind.

    ``verdicts`` has a + for each case that is right; ``public`` names kinds students can see.
    """
    cases = [{"name": kind, "args": [7.5], "public": kind in public, **case} for kind in kinds]
    outcomes = [r if isinstance(r, dict) else {"value": r} for r in right]
    return partial_credit(
        cases,
        outcomes,
        [sign == "+" for sign in verdicts],
        lambda i, outcome: agrees(close, cases[i], outcomes[i], dict(outcome)),
        most,
    )


def test_each_kind_of_hidden_input_earns_its_share_if_all_of_its_cases_are_right():
    assert credit("abcd", [2.0, 3.0, 4.0, 5.0], "+---") == 0.25
    assert credit("abcd", [2.0, 3.0, 4.0, 5.0], "+++-") == 0.75
    assert credit("aabb", [2.0, 3.0, 4.0, 5.0], "+-++") == 0.5
    assert credit("abb", [2.0, 3.0, 4.0], "--+") == 0


def test_the_share_is_rounded_down():
    assert credit("abc", [2.0, 3.0, 4.0], "++-") == 0.66
    assert credit("abcdefg", [2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 9.0], "+------") == 0.14


@pytest.mark.parametrize("verdicts", ["++", "+-", "--"])
def test_where_all_cases_are_public_nothing_is_earned(verdicts):
    """Their results can be copied: whoever does that must not earn everything."""
    assert credit("ab", [2.0, 3.0], verdicts, public="ab") == 0


def test_public_kinds_earn_nothing_and_failing_them_leaves_half_at_most():
    right = [2.0, 3.0, 4.0, 5.0, 6.0]
    assert credit("pabcd", right, "+++--", public="p") == 0.5
    assert credit("pabcd", right, "++++-", public="p") == 0.75
    assert credit("pabcd", right, "-+++-", public="p") == 0.5
    assert credit("pabcd", right, "-+---", public="p") == 0.25


def test_a_public_example_may_stand_anywhere_among_the_cases():
    assert credit("abcp", [2.0, 3.0, 4.0, 5.0], "+++-", public="p") == 0.5


def test_a_kind_of_which_one_case_is_public_still_counts():
    cases = [{"name": "a", "args": [7.5], "public": True}, {"name": "a", "args": [7.5]}]
    right = [{"value": 2.0}, {"value": 3.0}]
    given = [True, True]
    assert partial_credit(cases, right, given, lambda i, outcome: False, 1.0) == 0.99


def test_never_more_than_the_best_known_mistake_and_never_all():
    assert credit("abcd", [2.0, 3.0, 4.0, 5.0], "+++-", most=0.6) == 0.6
    assert credit("abcd", [2.0, 3.0, 4.0, 5.0], "+++-", most=0.8) == 0.75
    assert credit("ab", [2.0, 3.0], "++") == 0.99


@pytest.mark.parametrize(
    "trivial",
    [None, False, True, 0, 1, 0.0, [], np.zeros(0), np.zeros(3), np.zeros((2, 2), int), [[], []],
     np.eye(3), np.arange(4), 7.5, {"raised": "ValueError"}],
)  # fmt: skip
def test_what_looks_at_nothing_earns_nothing_of_its_own_and_its_loss_is_felt(trivial):
    right = [2.0, 3.0, trivial]
    assert credit("abt", right, "+-+") == 0.5
    assert credit("abt", right, "++-") == 0.66
    assert credit("ab", [trivial, trivial], "++") == 0


def test_the_input_returned_as_it_is_is_trivial_whichever_argument_it_is():
    cases = [{"name": "ab"[i], "args": [i + 7.5, i + 8.5]} for i in range(2)]
    right = [{"value": case["args"][1]} for case in cases]
    same = [lambda i, outcome: outcome["value"] == right[i]["value"], lambda i, outcome: False]
    assert partial_credit(cases, right, [True, False], _numbers_only(same[0]), 1.0) == 0
    assert partial_credit(cases, right, [True, False], same[1], 1.0) == 0.5


def _numbers_only(agree):
    return lambda i, outcome: type(outcome.get("value")) is float and agree(i, outcome)


@pytest.mark.parametrize("kind", [float, int])
def test_zeros_are_trivial_also_where_a_comparison_wants_one_type_of_number(kind):
    def strict(i, outcome):
        value = np.asarray(outcome.get("value"))
        return value.dtype == kind and value.shape == (3,) and not value.any()

    cases = [{"name": "a", "args": []}]
    for right in (np.zeros(3, kind), [0, 0, [0]]):  # a list may be one that is no array
        assert partial_credit(cases, [{"value": right}], [True], strict, 1.0) == 0


def test_a_kind_is_trivial_only_if_one_thing_is_right_on_all_its_cases():
    assert credit("tt", [0.0, 1.0], "++") == 0.99
    assert credit("tt", [0.0, 0.0], "++") == 0


def test_a_trivial_value_is_trivial_whatever_the_case_says_of_random_numbers():
    right = [{"value": 0.0, "drawn": 6}, {"value": 3.0, "drawn": 6}]
    assert credit("ab", right, "+-", draws=(5, 9)) == 0
    assert credit("ab", right, "-+", draws=(5, 9)) == 0.5
    right = [{"value": value, "drawn": 6} for value in (0.0, 3.0)]
    assert credit("ab", right, "+-", draws=(5, math.inf)) == 0


@pytest.mark.parametrize(
    ("value", "of_its_shape"),
    [
        (3.0, [np.array(0.0), np.array(0), [], np.arange(0)]),
        (np.ones((2, 3)), [np.zeros((2, 3)), np.zeros((2, 3), int), [], np.eye(2)]),
        (np.ones(4), [np.zeros(4), np.zeros(4, int), [], np.arange(4)]),
        ([[1], [2, 3]], [np.zeros(2), np.zeros(2, int), [[], []], np.arange(2)]),
    ],
)
def test_what_is_taken_for_trivial(value, of_its_shape):
    constants = [None, False, True, 0, 1, 0.0, [], np.zeros(0), np.zeros(0, int)]
    first, *others = _trivial({"args": [7.5, "x"]}, {"value": value})
    assert first == {"raised": "Exception"}
    expected = [*constants, *of_its_shape, 7.5, "x"]
    assert [repr(outcome["value"]) for outcome in others] == [repr(value) for value in expected]
