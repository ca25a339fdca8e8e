"""Each relation between what a function should return and returns, by an example by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest

from autograder.kinds.function.diagnosis import diagnose_function
from autograder.kinds.function.marking import close

# Arguments, right results and given ones, for two calls or more; numbers were worked out by hand.
LISTS = [[3, 1, 2, 2], [5, 4, 9, 0]]
MATRICES = [[[4.0, 1.0], [1.0, 2.0]], [[2.0, 0.5], [0.5, 1.0]]]
D = 180 / math.pi
EXAMPLES = {
    "returns nothing": (LISTS, [None, None]),
    "always the same": (LISTS, [[3, 1, 2, 2], [3, 1, 2, 2], [3, 1, 2, 2]]),
    "reversed": (LISTS, [[2, 2, 1, 3], [0, 9, 4, 5]]),
    "sorted": (LISTS, [[1, 2, 2, 3], [0, 4, 5, 9]]),
    "sorted downwards": (LISTS, [[3, 2, 2, 1], [9, 5, 4, 0]]),
    "sorted, without repetitions": (LISTS, [[1, 2, 3], [0, 4, 5, 9]]),
    "only the first": (LISTS, [3, 5]),
    "only the last": (LISTS, [2, 0]),
    "one too few": (LISTS, [[3, 1, 2], [5, 4, 9]]),
    "first left out": (LISTS, [[1, 2, 2], [4, 9, 0]]),
    "one too many": (LISTS, [[3, 1, 2, 2, 0], [5, 4, 9, 0, 0]]),
    "the largest": (LISTS, [3, 9]),
    "the smallest": (LISTS, [1, 0]),
    "where the largest is": (LISTS, [0, 2]),
    "where the smallest is": (LISTS, [1, 3]),
    "whether, not how much": (LISTS, [[True] * 4, [True, True, True, False]]),
    "the sum": (LISTS, [8, 18]),
    "the mean": (LISTS, [2.0, 4.5]),
    "shares of the whole": (LISTS, [[0.375, 0.125, 0.25, 0.25], [5 / 18, 4 / 18, 0.5, 0.0]]),
    "shares of the whole, in percent": (
        LISTS,
        [[37.5, 12.5, 25.0, 25.0], [500 / 18, 400 / 18, 50.0, 0.0]],
    ),
    "sign turned": (LISTS, [[-3, -1, -2, -2], [-5, -4, -9, 0]]),
    "twice": (LISTS, [[6, 2, 4, 4], [10, 8, 18, 0]]),
    "one more": (LISTS, [[4, 2, 3, 3], [6, 5, 10, 1]]),
    "one less": (LISTS, [[2, 0, 1, 1], [4, 3, 8, -1]]),
    "in percent": (LISTS, [[300, 100, 200, 200], [500, 400, 900, 0]]),
    "transposed": ([[[1, 2], [3, 4]], [[5, 6], [7, 8]]], [[[1, 3], [2, 4]], [[5, 7], [6, 8]]]),
    "both axes reversed": (MATRICES, [[[2.0, 1.0], [1.0, 4.0]], [[1.0, 0.5], [0.5, 2.0]]]),
    "only the diagonal": (MATRICES, [[4.0, 2.0], [2.0, 1.0]]),
    "off the diagonal": (MATRICES, [[[4.0, 0], [0, 2.0]], [[2.0, 0], [0, 1.0]]]),
    "inverse": (
        MATRICES,
        [[[2 / 7, -1 / 7], [-1 / 7, 4 / 7]], [[1 / 1.75, -0.5 / 1.75], [-0.5 / 1.75, 2 / 1.75]]],
    ),
    "matrix in degrees (second)": (
        MATRICES,
        [[[4.0, D], [D, 2 * D**2]], [[2.0, D / 2], [D / 2, D**2]]],
    ),
    "other order": ([[1.5, 0.5], [2.5, 0.25]], [[0.5, 1.5], [0.25, 2.5]]),
    "degrees (second result)": ([[1.5, 0.5], [2.5, 0.25]], [[1.5, 0.5 * D], [2.5, 0.25 * D]]),
    "other order, and degrees (second result)": (
        [[1.5, 0.5], [2.5, 0.25]],
        [[0.5 * D, 1.5], [0.25 * D, 2.5]],
    ),
    "degrees (first result), and sign turned (second result)": (
        [[0.5, 1.5], [0.25, 2.5]],
        [[0.5 * D, -1.5], [0.25 * D, -2.5]],
    ),
    "a quarter turn off (second result)": (
        [[1.5, 0.5], [2.5, 3.0]],
        [[1.5, 0.5 + math.pi / 2], [2.5, 3.0 - 1.5 * math.pi]],
    ),
    "rounded to 2 decimals": ([[1.2345, 0.5678], [2.7182, 0.1234]], [[1.23, 0.57], [2.72, 0.12]]),
    "only the first of each": ([[[1, 2], [3]], [[4], [5, 6]]], [[[1], [3]], [[4], [5]]]),
    "only the last of each": ([[[1, 2], [3]], [[4], [5, 6]]], [[[2], [3]], [[4], [6]]]),
    "counts for entries": ([[[7, 2], [3]], [[4], [5, 6, 9]]], [[2, 1], [1, 3]]),
    "empty ones left out": ([[[7, 2], []], [[], [5, 6, 9]]], [[[7, 2]], [[5, 6, 9]]]),
    "overflow of uint8": ([[300, 20, 256], [511, 5, 7]], [[44, 20, 0], [255, 5, 7]]),
    "overflow of int16": ([[40_000, 20], [65_536, -5]], [[-25_536, 20], [0, -5]]),
    "rounded to 2 decimals (first result)": (
        [[1.2345, 0.5678], [2.7182, 0.1234]],
        [[1.23, 0.5678], [2.72, 0.1234]],
    ),
    "from the other axis (second result)": (
        [[1.5, 0.5], [2.5, 3.0]],
        [[1.5, math.pi / 2 - 0.5], [2.5, math.pi / 2 - 3.0]],
    ),
    "more results": ([[1.5, 0.5], [2.5, 0.25]], [[1.5, 0.5, 7], [2.5, 0.25, 8]]),
    "wrong shape": (LISTS, [[[3], [1], [2], [2]], [[5], [4], [9], [0]]]),
    "a dictionary for a list": (
        LISTS,
        [{"0": 3, "1": 1, "2": 2, "3": 2}, {"0": 5, "1": 4, "2": 9, "3": 0}],
    ),
    "a text for a number": ([17, 4], ["17", "4"]),
    "more than asked for": (
        LISTS,
        [[[3, 8], [1, 8], [2, 7], [2, 7]], [[5, 1], [4, 1], [9, 1], [0, 1]]],
    ),
    "a constant factor": (
        [[3.0, 1.0, 2.0, 2.5], [5.0, 4.0, 9.0, 0.5]],
        [[5.1, 1.7, 3.4, 4.25], [8.5, 6.8, 15.3, 0.85]],
    ),
    "a constant more": (
        [[3.0, 1.0, 2.0, 2.5], [5.0, 4.0, 9.0, 0.5]],
        [[10.0, 8.0, 9.0, 9.5], [12.0, 11.0, 16.0, 7.5]],
    ),
    "counted from the other end": (
        [[3.0, 1.0, 2.0, 2.5], [5.0, 4.0, 9.0, 0.5]],
        [[7.0, 9.0, 8.0, 7.5], [5.0, 6.0, 1.0, 9.5]],
    ),
}


def same(case, changed, value) -> bool:
    return close({}, changed, value)


def diagnose(right, given, arguments=None):
    arguments = arguments or [[[10.0, 20.0, 30.0]]] * len(given)
    if len(right) < len(given):
        right = [*right, [8, 8, 8, 8]]
    cases = [{"name": f"case {n}", "args": args} for n, args in enumerate(arguments)]
    outcomes = [{"value": value} for value in given]
    verdicts = [close({}, one, other) for one, other in zip(right, given, strict=True)]
    return diagnose_function(cases, [{"value": value} for value in right], outcomes, verdicts, same)


@pytest.mark.parametrize("name", EXAMPLES)
def test_a_relation_is_told_by_its_name(name: str):
    right, given = EXAMPLES[name]
    found = diagnose(right, given)
    assert found is not None
    assert found.name == name
    assert found.sentence.startswith("It looks as if ")
    assert found.sentence.endswith(".")


@pytest.mark.parametrize("name", EXAMPLES)
def test_a_relation_that_fails_on_one_case_gives_no_such_name(name: str):
    right, given = EXAMPLES[name]
    found = diagnose([*right[: len(given)], [6, 1, 8, 3]], [*given, [2, 7, 1, 9]])
    assert found is None or found.name != name


@pytest.mark.parametrize(
    ("arguments", "right", "given", "name"),
    [
        ([[[4, 7]], [[1, 5]]], [[0.5], [0.25]], [[4.0, 7.0], [1.0, 5.0]], "returns its input"),
        ([[[1, 2, 3, 4]], [[2, 4, 6]]], [2.5, 4.0], [10.0, 12.0], "a sum for a mean"),
        ([[[1, 2, 3, 4]], [[2, 4, 6]]], [10.0, 12.0], [2.5, 4.0], "a mean for a sum"),
        ([[[1, 2, 3, 4]], [[2, 4, 6]]], [2.25, 8.0], [3.0, 12.0], "N - 1 for N"),
        ([[[7, 8, 9]], [[5, 6, 7]]], [[0, 2], [1]], [[7, 9], [6]], "entries for indices"),
        (
            [[[7, 8, 9]], [[5, 6, 7]]],
            [[0, 2], [1]],
            [[True, False, True], [False, True, False]],
            "mask for indices",
        ),
    ],
)  # fmt: skip
def test_a_relation_to_the_arguments_is_told_by_its_name(arguments, right, given, name):
    arguments = [[np.array(value, dtype=float) for value in case] for case in arguments]
    found = diagnose(right, given, arguments)
    assert found is not None
    assert found.name == name


def test_right_values_and_chance_have_no_name():
    assert diagnose(LISTS, LISTS) is None
    assert diagnose(LISTS, [[7, 0, 4, 11], [2, 8, 1, 6]]) is None
    assert diagnose(LISTS[:1], [[2, 2, 1, 3]]) is None  # one case says nothing
