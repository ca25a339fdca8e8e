"""The mark of an expression, straight from values: no expression is evaluated here."""

from __future__ import annotations

import zlib
from typing import Any

import numpy as np
import pytest

from autograder.kinds.expression.answer import ExpressionAlternative, ExpressionAnswer
from autograder.kinds.expression.equal_values import (
    TOLERANCE,
    almost_same_values,
    nearly_equal,
    same_values,
)
from autograder.kinds.expression.marking import hidden_points, mark_expression, matches
from autograder.kinds.expression.question import Expression
from autograder.questions.drawn import NOTHING_AROUND, Around
from autograder.questions.mark import Mark

QUESTION = Expression(
    id="Q9", chapter="c", title="t", prompt="p", points=4.0, hints=("h",), variable="x",
    symbols={"a": "one side", "b": "the other"},
)  # fmt: skip
KNOWN = (
    ExpressionAlternative(name="right", credit=1.0, expression="2*(a + b)", feedback=""),
    ExpressionAlternative(name="half", credit=0.5, expression="a + b", feedback="Once round."),
    ExpressionAlternative(name="area", credit=0.0, expression="a*b", feedback="Round, not in."),
)


def answer_of(*known: ExpressionAlternative, **more: Any) -> ExpressionAnswer:
    return ExpressionAnswer(
        id="Q9", explanation="why", sample={"a": (1.0, 5.0), "b": (2.0, 3.0), "s": (0.0, 1.0),
                                            "t": (7.0, 8.0)},
        alternatives=known or KNOWN, **more,
    )  # fmt: skip


ANSWER = answer_of()
POINTS = hidden_points(answer_of(free_of=("s", "t")), np.random.default_rng(3))
A, B, S, T = (POINTS[name] for name in "abst")
RIGHT = 2 * (A + B)
NEIGHBOR = ExpressionAlternative(name="right", credit=1.0, expression="a**3*b")
NEAR = Around(((QUESTION, answer_of(NEIGHBOR)),))


def mark(values: Any, answer: ExpressionAnswer = ANSWER, around: Around = NOTHING_AROUND) -> Mark:
    return mark_expression(QUESTION, answer, POINTS, values, around)


def test_points_are_drawn_in_their_ranges_and_again_only_for_what_is_to_be_absent():
    answer = ExpressionAnswer(
        id="Q9", sample={"a": (1.0, 5.0), "r": (-2.0, 2.0)}, derived={"d": "a*r", "dd": "d + 1"},
        free_of=("r",),
    )  # fmt: skip
    points = hidden_points(answer, np.random.default_rng(4))
    rng = np.random.default_rng(4)  # 24 numbers each, in this order
    a, r, again = rng.uniform(1, 5, 24), rng.uniform(-2, 2, 24), rng.uniform(-2, 2, 24)
    assert np.array_equal(points["a"], np.concatenate([a, a]))
    assert np.array_equal(points["r"], np.concatenate([r, again]))
    assert np.array_equal(points["d"], points["a"] * points["r"])
    assert np.array_equal(points["dd"], points["d"] + 1)


@pytest.mark.parametrize("values", [RIGHT, RIGHT + 0j, RIGHT * (1 + 1e-9), RIGHT.astype("f4")])
def test_equal_values_are_right(values):
    assert mark(values) == Mark(
        "Q9", "right", 1.0, 4.0, "Right.", alternative="right", explanation="why"
    )


def test_an_alternative_says_what_it_earns():
    for values, name, credit, feedback, status in (
        (A + B, "half", 0.5, "Once round.", "partial"),
        (A * B, "area", 0.0, "Round, not in.", "wrong"),
    ):
        assert mark(values) == Mark(
            "Q9", status, credit, 4.0, feedback, alternative=name, explanation="why"
        )


@pytest.mark.parametrize(
    "values",
    [
        None, 3.0, RIGHT.tolist(), RIGHT[:-1], RIGHT[:24], np.append(RIGHT, 1.0), RIGHT.astype(int),
        RIGHT > 5, RIGHT.astype(object), RIGHT.astype(str), RIGHT[None, :0], RIGHT[:0],
        np.zeros((0, 48)), np.tile(RIGHT, (9, 1)), RIGHT[None, None],
        np.float64(3.0), np.array(3.0), {"values": RIGHT},
    ],
)  # fmt: skip
def test_what_is_no_row_of_values_is_wrong(values):
    assert mark(values) == Mark(
        "Q9", "wrong", 0.0, 4.0, "It has no numeric values.", explanation="why"
    )


def test_of_several_roots_the_one_that_earns_least_decides():
    for rows, name in (
        ([RIGHT, RIGHT], "right"),
        ([RIGHT], "right"),
        ([RIGHT, A + B], "half"),
        ([A + B, RIGHT], "half"),
        ([A + B, RIGHT, A * B], "area"),
        ([A * B, A + B, RIGHT], "area"),
        ([RIGHT, A * B, A + B], "area"),
    ):
        assert mark(np.array(rows)).alternative == name
    assert mark(np.array([RIGHT, A**3 * B]), answer_of(KNOWN[0]), NEAR).alternative == (
        "another question's answer"
    )


def test_where_some_of_several_roots_are_right_this_is_told_before_what_is_wrong():
    one = mark(np.array([RIGHT, A * B, A + B]))
    assert one.feedback.startswith("1 of your 3 results is right. About another one: ")
    assert one.feedback.endswith(mark(A * B).feedback)
    assert "2 of your 3 results are right." in mark(np.array([RIGHT, A + B, RIGHT])).feedback
    assert mark(np.array([A * B, A + B])).feedback == mark(A * B).feedback
    assert mark(np.array([RIGHT, RIGHT])).feedback == mark(RIGHT).feedback


def test_what_it_has_to_be_free_of_is_named():
    free = answer_of(free_of=("s", "t"))
    for values in (RIGHT + S, RIGHT + T, RIGHT + 1e-5 * S + 0j):
        assert mark(values, free) == Mark(
            "Q9", "wrong", 0.0, 4.0, "It still depends on s, t.", alternative="depends on s, t",
            explanation="why",
        )  # fmt: skip
    told = answer_of(free_of=("s",), free_of_feedback="Put s in.")
    assert mark(RIGHT + S, told).feedback == "Put s in."
    assert mark(RIGHT, free).status == "right"
    with_s = ExpressionAlternative(name="with s", credit=1.0, expression="a + s")
    assert mark(A + S, answer_of(with_s)).status == "right"  # nobody asks for more here


def test_a_wrong_expression_gets_a_name_and_what_it_was_found_by():
    verdict = mark(7 * (A + B), answer_of(KNOWN[0]))
    assert (verdict.status, verdict.credit, verdict.max_points) == ("wrong", 0.0, 4.0)
    assert verdict.alternative == "a constant factor"
    assert verdict.feedback == (
        "It looks as if only a constant factor is wrong: the form is right."
    )
    assert (verdict.evidence, verdict.explanation) == ("factor 3.5", "why")


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("size", [1e308, 1e308j, 1e-320, np.nan, np.inf])
def test_values_of_any_size_are_compared_without_a_warning(size):
    sums = ExpressionAlternative(
        name="right", credit=1.0, expression="3*a - 2*b + a*b", feedback=""
    )
    for answer in (ANSWER, answer_of(sums)):
        assert mark(np.full(RIGHT.shape, size), answer).credit == 0


def test_the_answer_to_a_neighbor_is_told():
    alone = answer_of(KNOWN[0])
    assert mark(A**3 * B, alone, NEAR).alternative == "another question's answer"
    assert mark(A**3 * B, alone).alternative is None


def test_a_nameless_expression_has_a_word_in_common_with_its_equals():
    values = np.exp(A) * B
    verdict = mark(values)
    assert (verdict.status, verdict.credit, verdict.max_points) == ("wrong", 0.0, 4.0)
    assert verdict.alternative is None
    assert verdict.feedback == (
        "It differs from the right expression, and from the mistakes known here. Put a simple "
        "data set into both sides and see where they part."
    )
    digits = ",".join(f"{value:.6g}" for value in values)
    assert verdict.evidence == f"values {zlib.crc32(digits.encode()):08x}"
    assert verdict.explanation == "why"


def test_an_alternative_matches_up_to_its_period_where_it_has_one():
    points = {"a": np.linspace(0.0, 3.0, 8)}
    angle = ExpressionAlternative(name="x", credit=1.0, expression="a", modulo="2*pi")
    turns = 2 * np.pi * np.arange(8)
    assert matches(angle, points, points["a"] + turns) is True
    assert matches(angle, points, points["a"] + turns / 2) is False
    plain = ExpressionAlternative(name="x", credit=1.0, expression="a")
    assert matches(plain, points, points["a"] + turns) is False
    constant = ExpressionAlternative(name="x", credit=1.0, expression="3")
    assert matches(constant, points, np.full(8, 3.0)) is True
    assert matches(constant, points, points["a"]) is False


def test_values_have_to_be_there_wherever_the_key_is_defined_and_nowhere_else():
    points = {"a": np.linspace(-3.0, 12.0, 8)}
    root = ExpressionAlternative(name="x", credit=1.0, expression="sqrt(a)")
    values = np.where(points["a"] > 0, np.sqrt(np.abs(points["a"])), 77.0)
    assert matches(root, points, values) is True
    values[-1] = np.nan
    assert matches(root, points, values) is False


def row(*values: complex) -> np.ndarray:
    return np.array(values)


@pytest.mark.parametrize(
    ("expected", "actual", "equal"),
    [
        (1000.0, 1000.0 + 0.9e-4, True),
        (1000.0, 1000.0 + 1.1e-4, False),
        (-1000.0, -1000.0 - 0.9e-4, True),
        (-1000.0, -1000.0 + 1.1e-4, False),
        (0.0, 0.9e-10, True),
        (0.0, -1.1e-10, False),
        (1e-4, 1e-4 + 0.9e-10, True),
        (1.0, 1.0 + 0.9e-7j, True),
        (1.0, 1.0 + 1.1e-7j, False),
        (1.0, np.nan, False),
        (1.0, np.inf, False),
        (np.inf, np.inf, False),
    ],
)
def test_values_are_equal_to_seven_digits_or_ten_decimals(expected, actual, equal):
    assert nearly_equal(row(2.0, expected, 3.0), row(2.0, actual, 3.0)) is equal
    if np.isfinite(expected):
        assert same_values(row(2.0, expected, 3.0), row(2.0, actual, 3.0), None) is equal


def test_at_the_very_edge_of_the_tolerance_values_are_equal():
    assert nearly_equal(row(0.0), row(TOLERANCE * 1e-3))
    assert not nearly_equal(row(0.0), row(TOLERANCE * 1.0001e-3))


def test_a_value_that_is_not_finite_warns_of_nothing():
    with np.errstate(all="raise"):
        for value in (np.inf, -np.inf, np.nan):
            assert same_values(row(1.0, 2.0), row(value, 2.0), 3.0) is False


def test_values_count_where_the_expected_ones_are_defined_in_a_quarter_of_the_points_at_least():
    two = row(1.0, np.nan, np.nan, np.nan, np.inf, np.nan, np.nan, 2.0)
    assert same_values(two, row(1.0, 7.0, np.nan, np.inf, 5.0, 0.0, 0.0, 2.0), None) is True
    assert same_values(two, row(1.0, 7.0, 0.0, 0.0, 5.0, 0.0, 0.0, 3.0), None) is False
    one = row(1.0, *[np.nan] * 7)
    assert same_values(one, np.ones(8), None) is False
    three = row(1.0, 1.0, 1.0, *[np.nan] * 9)
    assert same_values(three, np.ones(12), None) is True
    assert same_values(two, row(4.0, 7.0, 0.0, 0.0, 5.0, 0.0, 0.0, -1.0), 3.0) is True


@pytest.mark.parametrize(
    ("values", "same"),
    [
        ([1.0, 2.0], True),
        ([4.0, -1.0], True),
        ([-29.0, 302.0], True),
        ([1.0 + 3.0j, 2.0], False),  # a turn is real
        ([1.0, 2.0 + 0.9e-7j], True),
        ([1.0, 3.5], False),
        ([1.0 + 0.9e-7, 2.0 - 1.9e-7], True),
        ([1.0 + 1.1e-7, 2.0], False),
        ([np.inf, 2.0], False),
        ([1.0, np.nan], False),
    ],
)
def test_whole_turns_are_taken_off_where_there_is_a_period(values, same):
    assert same_values(row(1.0, 2.0), row(*values), 3.0) is same


def test_a_rounded_number_moves_values_by_little_of_the_largest():
    expected = np.array([1.0, -1000.0, 2.0, np.nan])
    assert almost_same_values(expected, expected * (1 + 1e-4), None) is True
    assert almost_same_values(expected, np.array([3.0, -1000.0, 2.0, 7.0]), None)
    assert not almost_same_values(expected, np.array([3.01, -1000.0, 2.0, 7.0]), None)
    assert not almost_same_values(expected, -expected, None)
    assert not almost_same_values(expected, np.array([1.0, -1000.0, np.nan, 7.0]), None)
    assert almost_same_values(expected, expected + np.array([0, 12, -24, 0]), 12.0)
    assert almost_same_values(np.full(4, np.nan), np.ones(4), None) is False


@pytest.mark.parametrize(("rows", "status"), [(8, "right"), (9, "wrong")])
def test_eight_results_are_marked_and_no_more(rows: int, status: str):
    assert mark(np.tile(RIGHT, (rows, 1))).status == status
