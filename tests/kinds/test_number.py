"""Numbers: integers exactly, others as finely as the question asks."""

import math
from dataclasses import replace
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from autograder.kinds.number.answer import NumberAlternative, NumberAnswer
from autograder.kinds.number.marking import mark_number
from autograder.kinds.number.question import Number
from autograder.marking import Mark
from autograder.marking.marker import Marker
from autograder.sandbox.inside.evaluate import evaluate

COMMON = {"id": "Q9", "chapter": "c", "title": "t", "prompt": "p", "points": 4.0, "hints": ("h",)}


def answer_of(*alternatives: tuple[float, float], tolerance: float | None = None) -> NumberAnswer:
    """Alternatives as (value, credit)."""
    return NumberAnswer(
        id="Q9",
        explanation="why",
        code="",
        alternatives=tuple(
            NumberAlternative(
                name=str(value) + "'" * n,
                credit=credit,
                feedback=f"feedback on {value}",
                value=value,
                tolerance=tolerance,
            )
            for n, (value, credit) in enumerate(alternatives)
        ),
    )


def mark(value: float, answer: NumberAnswer, understood: str = "", **question: object) -> Mark:
    asked = Number(**COMMON, variable="x", **question)  # type: ignore[arg-type]
    return mark_number(asked, answer, value, understood)


@given(truth=st.integers(-(10**6), 10**6), off=st.integers(-3, 3))
def test_an_integer_is_right_exactly(truth, off):
    answer = answer_of((truth, 1.0))
    assert mark(truth + off, answer, integer=True).status == ("right" if off == 0 else "wrong")
    assert mark(float(truth + off), answer, integer=True).credit == (off == 0)


@given(truth=st.integers(1, 10**6), part=st.floats(0.01, 0.99))
def test_a_fraction_in_place_of_an_integer_is_wrong_and_told_so(truth, part):
    verdict = mark(truth + part, answer_of((truth, 1.0)), integer=True)
    assert verdict.status == "wrong"
    assert "whole number" in verdict.feedback


@given(
    truth=st.decimals(-1000, 1000, places=7),
    decimals=st.integers(0, 6),
    more=st.integers(0, 7),
)
def test_any_rounding_at_least_as_fine_as_asked_is_right(truth, decimals, more):
    """Rounded by the decimal module, half to even or half up alike."""
    places = min(decimals + more, 7)
    for rounding in ("ROUND_HALF_EVEN", "ROUND_HALF_UP"):
        rounded = float(truth.quantize(Decimal(10) ** -places, rounding=rounding))
        verdict = mark(rounded, answer_of((float(truth), 1.0)), decimals=decimals)
        assert verdict.status == "right"


@given(
    truth=st.decimals(-1000, 1000, places=7), decimals=st.integers(0, 6), units=st.floats(0.51, 9)
)
def test_more_than_half_of_the_last_decimal_off_is_wrong(truth, decimals, units):
    for sign in (-1, 1):
        value = float(truth) + sign * units * 10.0**-decimals
        assert mark(value, answer_of((float(truth), 1.0)), decimals=decimals).status == "wrong"


@given(truth=st.floats(-100, 100), tolerance=st.floats(0.01, 10), part=st.floats(0, 3))
def test_a_tolerance_of_its_own_takes_the_place_of_the_decimals(truth, tolerance, part):
    if abs(part - 1) > 1e-3:
        answer = answer_of((truth, 1.0), tolerance=tolerance)
        verdict = mark(truth + part * tolerance, answer, decimals=6)
        assert verdict.credit == (part < 1)


@given(st.lists(st.sampled_from([0.0, 0.25, 0.5, 1.0]), min_size=1, max_size=5), st.integers(0, 9))
def test_the_first_alternative_that_matches_decides(credits, value):
    answer = answer_of(*((value, credit) for credit in credits))
    verdict = mark(value, answer, integer=True)
    assert verdict.credit == credits[0]
    assert verdict.status == {0.0: "wrong", 1.0: "right"}.get(credits[0], "partial")
    assert verdict.points == 4 * credits[0]
    assert verdict.feedback == f"feedback on {value}"


def test_an_unknown_value_earns_nothing_and_points_to_the_hints():
    verdict = mark(5, answer_of((3, 1.0), (4, 0.5)), integer=True)
    assert (verdict.status, verdict.credit, verdict.alternative) == ("wrong", 0, None)
    assert "hint" in verdict.feedback
    assert verdict.explanation == "why"


def test_the_value_is_repeated_with_its_unit():
    verdict = mark(1 / 3, answer_of((1, 1.0)), str(1 / 3), decimals=2, unit="m")
    assert verdict.understood == "0.3333333333 m"
    assert mark(1.0, answer_of((1, 1.0)), decimals=2, unit="m").understood == "1 m"
    known = mark(1.0986, answer_of((1.0986, 1.0)), "log(3)", decimals=4, unit="m")
    assert known.understood == "1.0986 m"


@pytest.mark.parametrize("before", ["", "log(3)", "<Liar object at 0x7f>", "-1.0"])
def test_a_value_that_the_key_does_not_know_is_shown_as_it_was_before_it_was_evaluated(before):
    """It may be a hidden input by then, which another response has kept."""
    verdict = mark(987.654321, answer_of((1, 1.0)), before, decimals=2)
    assert verdict.understood == before.removesuffix(".0")
    assert "987" not in str(replace(verdict, evidence=""))  # that is for the instructor alone


@pytest.fixture
def marker(toy) -> Marker:
    return Marker(toy.load(), seed=1)


def given_number(marker: Marker, response: object) -> Mark:
    """Marked as the grader does it: evaluated over there, marked here. The answer is 12 eggs."""
    return marker.mark("Q1.3", evaluate(response, marker.drawn("Q1.3").probe))


@pytest.mark.parametrize(
    "response",
    [
        12,
        12.0,
        np.int64(12),
        np.float32(12),
        np.array(12),
        np.array([12]),
        [12],
        {12},
        Fraction(24, 2),
        Decimal("12"),
        12 + 0j,
        sp.Integer(12),
        sp.Float("12.0"),
        sp.Rational(24, 2),
        sp.ceiling(sp.Float("11.3")),
        sp.sqrt(144),
        [[12]],
        sp.Matrix([12]),
        sp.FiniteSet(12),
        sp.solve([sp.Symbol("k") - 12], [sp.Symbol("k")]),
        sp.solve(sp.Symbol("k") - 12, dict=True),
        sp.linsolve([sp.Symbol("k") - 12], sp.Symbol("k")),
    ],
    ids=lambda response: f"{type(response).__module__}.{type(response).__name__}",
)
def test_a_right_number_of_any_type_is_right(marker, response):
    assert given_number(marker, response).status == "right"


@pytest.mark.parametrize(
    ("response", "said"),
    [
        ("12", "a string; write it without quotes"),
        (lambda: 12, "function"),
        ([12, 12], "several values"),
        (True, "not a number"),
        (12 + 1j, "not a number"),
        (None, "not a number"),
        (math.inf, "not a finite number"),
        (math.nan, "not a finite number"),
        (10**400, "not a finite number"),
        (sp.Symbol("k") * 12, "still contains symbols"),
        ([], "it is empty"),
        (np.array([]), "it is empty"),
        (sp.Eq(sp.Symbol("k"), 12), "it is an equation"),
        (sp.Lambda(sp.Symbol("k"), 12), "it is a function"),
        (object(), "not a number"),
        (sp.FiniteSet(12, 13), "several values"),
        (sp.Matrix([12, 13]), "several values"),
        ({sp.Symbol("k"): 12, sp.Symbol("n"): 12}, "several values"),
        (sp.Interval(12, 12.5), "not a number"),
        (sp.true, "not a number"),
        ({"k": 12}, "not a number"),
    ],
)
def test_what_is_no_number_is_wrong_and_told_why(marker, response, said):
    mark = given_number(marker, response)
    assert (mark.status, mark.credit, mark.alternative) == ("wrong", 0, "not usable")
    assert said in mark.feedback


def test_a_list_that_holds_itself_is_no_number(marker):
    endless: list[object] = []
    endless.append(endless)
    assert given_number(marker, endless).alternative == "not usable"


@pytest.mark.parametrize(
    "response",
    [
        np.float32(0.18),
        np.float16(0.18),
        np.array([0.18], dtype=np.float32),
        np.round(np.float32(0.1801), 2),
        sp.N(sp.Float("0.18014"), 2),
        1 - 0.82,  # 0.18000000000000005
        0.1 + 0.08,
    ],
    ids=repr,
)
def test_a_number_is_as_fine_as_it_is_written_and_not_as_it_is_kept(response):
    """Two decimals count as rounded, whatever the computer makes of the others."""
    value = evaluate(response, {"kind": "number"})["value"]
    assert mark(value, answer_of((0.1801, 1.0)), decimals=2).status == "right"


def test_the_stub_and_a_missing_variable_are_not_attempted(marker):
    assert given_number(marker, ...).status == "not attempted"
    missing = marker.mark("Q1.3", {"state": "unusable", "reason": "missing"})
    assert missing.status == "not attempted"
    assert missing.feedback == "Nothing called eggs was found."


def test_a_response_that_raises_when_it_is_read_is_an_error(marker):
    class Moody:
        def __float__(self) -> float:
            raise RuntimeError("12")

    mark = given_number(marker, Moody())
    assert mark.status == "error"
    assert "12" not in mark.feedback


def test_partial_credit_of_the_toy_course(marker):
    mark = given_number(marker, 7)
    assert (mark.status, mark.credit, mark.points, mark.alternative) == (
        "partial", 0.25, 0.5, "added",
    )  # fmt: skip
    assert mark.understood == "7 eggs"


def test_a_value_at_the_very_edge_of_a_tolerance_is_within_it():
    assert mark(2.5, answer_of((2.0, 1.0), tolerance=0.5), decimals=2).credit == 1.0


def test_a_wrong_value_that_relates_to_the_right_one_is_named_by_how():
    verdict = mark(-12.25, answer_of((12.25, 1.0)), decimals=2)
    assert (verdict.status, verdict.credit) == ("wrong", 0.0)
    assert verdict.alternative == "sign turned"
    assert verdict.feedback.startswith("It looks as if")
    assert "sign" in verdict.feedback


def test_only_where_a_whole_number_is_asked_for_is_one_asked_for():
    verdict = mark(7.77, answer_of((12.25, 1.0)), decimals=2)
    assert verdict.alternative is None
    assert "whole number" not in verdict.feedback


def test_a_mistake_that_gives_no_whole_number_is_known_when_it_is_rounded():
    answer = answer_of((206, 1.0), (1 / 0.12**2, 0.25))  # 69.444...
    for value in (69, 1 / 0.12**2, 69.44):
        assert mark(value, answer, integer=True).feedback == "feedback on 69.44444444444444"
    assert mark(70, answer, integer=True).credit == 0
