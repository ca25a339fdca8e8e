"""The answers of the exercise sheet, computed here independently, get full credit.

And what students typically get wrong is named.
"""

import math
from fractions import Fraction

import numpy as np
import pytest
import sympy as sp

from autograder.marking import Mark
from autograder.marking.marker import Marker
from autograder.sandbox.inside.evaluate import evaluate

N, INLIERS = 1000, 200
W, P = Fraction(1, 5), Fraction(19, 20)


@pytest.fixture(scope="module")
def marker(request) -> Marker:
    return Marker(request.getfixturevalue("real_course"), seed=7)


def mark(marker: Marker, id: str, response: object) -> Mark:
    """Marked as the grader does it: evaluated over there, marked here."""
    return marker.mark(id, evaluate(response, marker.drawn(id).probe))


def first_enough(clean: Fraction) -> int:
    """The first number of draws that all fail with probability 1 - P at most, found by counting."""
    draws, failure = 0, Fraction(1)
    while failure > 1 - P:
        draws, failure = draws + 1, failure * (1 - clean)
    return draws


# The sheet's letters.


@pytest.mark.parametrize(("id", "truths"), [("Q1.1", "TTFF"), ("Q2.1", "TFT"), ("Q3.1", "FFTT")])
def test_the_truth_values_are_those_of_the_sheet(marker, id, truths):
    response = [letter == "T" for letter in truths]
    assert marker.mark(id, response).status == "right"
    for position in range(len(truths)):
        turned = [said != (index == position) for index, said in enumerate(response)]
        verdict = marker.mark(id, turned)
        assert verdict.points == len(truths) - 1
        assert [part.right for part in verdict.parts].index(False) == position
        assert len(verdict.parts[position].feedback) > 40  # the misconception is named


# The sheet: cards are listed as 1, 7, 5, 2, 10, 8, 12, 3, 11, 4, 6, 9 of the right order.
DEALT = [1, 7, 5, 2, 10, 8, 12, 3, 11, 4, 6, 9]
BEFORE = [
    (1, 2),
    (2, 3),
    (3, 5),
    (4, 5),
    (5, 6),
    (6, 7),
    (7, 8),
    (8, 9),
    (9, 10),
    (10, 11),
    (11, 12),
]


def cards(marker: Marker, places: list[int]) -> list[str]:
    """Card ids for places in the sheet's right order."""
    start = marker.course.question("Q1.2").start
    by_place = dict(zip(DEALT, start, strict=True))
    return [by_place[place] for place in places]


def test_the_order_of_the_sheet_is_right(marker):
    verdict = marker.mark("Q1.2", cards(marker, list(range(1, 13))))
    assert (verdict.status, verdict.points) == ("right", verdict.max_points)


def test_the_cards_as_the_sheet_lists_them_are_not_attempted(marker):
    assert marker.mark("Q1.2", cards(marker, DEALT)).status == "not attempted"


def test_the_model_images_features_may_come_at_any_time_before_their_words(marker):
    rest = [place for place in range(1, 13) if place != 4]
    for at in range(len(rest) + 1):
        places = [*rest[:at], 4, *rest[at:]]
        expected = all(places.index(first) < places.index(second) for first, second in BEFORE)
        assert (marker.mark("Q1.2", cards(marker, places)).status == "right") == expected
        assert expected == (at <= 3)


def test_the_two_cards_of_the_same_text_are_interchangeable(marker):
    places = [1, 2, 3, 4, 9, 6, 7, 8, 5, 10, 11, 12]
    assert marker.mark("Q1.2", cards(marker, places)).status == "right"


def test_every_other_exchange_of_two_neighbors_costs_one_move(marker):
    for at in range(11):
        places = list(range(1, 13))
        places[at], places[at + 1] = places[at + 1], places[at]
        verdict = marker.mark("Q1.2", cards(marker, places))
        free = at == 2  # cards 3 and 4: the model images' features
        assert verdict.credit == pytest.approx(1 if free else 1 - 2 / 12)


# The sheet's numbers.


def test_the_numbers_of_iterations_are_74_and_373():
    assert (first_enough(W**2), first_enough(W**3)) == (74, 373)


def test_drawn_without_replacement_they_are_74_and_378():
    line = Fraction(math.comb(INLIERS, 2), math.comb(N, 2))
    plane = Fraction(math.comb(INLIERS, 3), math.comb(N, 3))
    assert (first_enough(line), first_enough(plane)) == (74, 378)


def pairs() -> int:
    """Every point with each that comes after it."""
    return sum(N - 1 - first for first in range(N))


RIGHT_NUMBERS = {
    "Q3.2.1": [first_enough(W**2), 74, 74.0],
    "Q3.2.2": [pairs(), 499500],
    "Q3.2.3b": [0.18, 0.180, float((1 - W**2) ** 42), math.exp(42 * math.log1p(-0.04))],
    "Q3.2.4": [0.98, 0.983, 0.9831, float(1 - (1 - W**2) ** 100)],
    "Q3.2.5": [first_enough(W**3), 373, 378],
}


@pytest.mark.parametrize("id", RIGHT_NUMBERS)
def test_the_numbers_of_the_sheet_get_full_credit(marker, id):
    for value in RIGHT_NUMBERS[id]:
        verdict = mark(marker, id, value)
        assert (verdict.status, verdict.credit) == ("right", 1), value


def test_378_planes_come_with_a_note_on_the_exact_count(marker):
    exact, usual = mark(marker, "Q3.2.5", 378), mark(marker, "Q3.2.5", 373)
    assert "373" in exact.feedback
    assert exact.points == usual.points == exact.max_points
    assert exact.alternative != usual.alternative


def iterations(clean: float, p: float = 0.95) -> float:
    return math.log(1 - p) / math.log(1 - clean)


# What students type instead, computed as they do; the words that the feedback must contain.
WRONG_NUMBERS: dict[str, list[tuple[float, str]]] = {
    "Q3.2.1": [
        (math.floor(iterations(0.04)), "rounded"),
        (iterations(0.04), "iteration"),
        (math.ceil(iterations(0.2)), "two inliers"),
        (math.floor(iterations(0.2)), "two"),
        (math.ceil(-math.log(0.05) / 0.04), "log"),
        (math.ceil(iterations(0.64)), "outliers"),
        (math.ceil(iterations(0.04, p=0.05)), "0.95"),
        (math.ceil(iterations(0.008)), "three points"),
        (1 / 0.04, "average"),
        (math.ceil(iterations(1 - 0.8**2)), "both"),
    ],
    "Q3.2.2": [
        (N * (N - 1), "twice"),
        (N**2, "itself"),
        (N**2 / 2, "first"),
        (N * (N + 1) / 2, "itself"),
        (math.comb(INLIERS, 2), "inliers"),
        (math.comb(N, 3), "plane"),
    ],
    "Q3.2.3b": [
        (1 - 0.96**42, "complement"),
        (100 * 0.96**42, "percent"),
        (18, "percent"),
        (0.96, "one iteration"),
        (42 * 0.96, "greater than 1"),
        (0.8**42, "single point"),
        (0.992**42, "three points"),
        (42 * 0.04, "probability"),
    ],
    "Q3.2.4": [
        (0.96**100, "complement"),
        (98.3, "percent"),
        (1 - 0.8**100, "w²"),
        (1 - 0.992**100, "three points"),
        (100 * 0.04, "exceed 1"),
        (0.95, "goal"),
        (1 - 0.96**42, "42"),
    ],
    "Q3.2.5": [
        (math.floor(iterations(0.008)), "rounded"),
        (iterations(0.008), "whole"),
        (math.ceil(iterations(0.04)), "line"),
        (math.ceil(iterations(0.2**4)), "four"),
        (math.ceil(iterations(0.2)), "one inlier"),
        (math.ceil(-math.log(0.05) / 0.008), "log"),
        (74 * 3 / 2, "3/2"),
        (74 * 5, "5 times"),
        (math.ceil(iterations(0.8**3)), "20 %"),
    ],
}


@pytest.mark.parametrize("id", WRONG_NUMBERS)
def test_every_typical_slip_in_a_number_is_named(marker, id):
    found = set()
    for value, words in WRONG_NUMBERS[id]:
        verdict = mark(marker, id, value)
        assert verdict.status in ("wrong", "partial"), value
        assert verdict.credit < 1
        assert verdict.alternative not in (None, "right"), value
        assert words in verdict.feedback, value
        found.add(verdict.alternative)
    keyed = {entry.name for entry in marker.course.key[id].alternatives if entry.is_mistake}
    assert found == keyed, "a keyed mistake is not tried here"


@pytest.mark.parametrize("id", RIGHT_NUMBERS)
def test_any_other_number_earns_nothing(marker, id):
    for value in (-1, 12345, 0.3333, 0.5001, 1e9):
        verdict = mark(marker, id, value)
        assert (verdict.status, verdict.credit, verdict.alternative) == ("wrong", 0, None), value


# The sheet's formulas, and what goes wrong on the way. The right ones, rewritten in many ways, are
# in marking/test_expression.py.

r, alpha, n, x_c, y_c, sum_x, sum_y = sp.symbols("r alpha N x_c y_c sum_x sum_y")
S_xx, S_yy, S_xy, w = sp.symbols("S_xx S_yy S_xy w", real=True)
c, s = sp.cos(alpha), sp.sin(alpha)
COST = S_xx * c**2 + 2 * S_xy * s * c + S_yy * s**2
SLOPE, CURVATURE = sp.diff(COST, alpha), sp.diff(COST, alpha, 2)
RATIO = -2 * S_xy / (S_yy - S_xx)

RIGHT_EXPRESSIONS = {
    "Q2.2a": sp.diff(sum((r - x * c - y * s) ** 2 for x, y in [(x_c, y_c)]), r) * n,
    "Q2.2b": x_c * c + y_c * s,
    "Q2.2c": COST,
    "Q2.2d": SLOPE,
    "Q2.2e": sp.atan(RATIO) / 2,
    "Q2.2f1": CURVATURE,
    "Q2.2f2": sp.atan2(-2 * S_xy, S_yy - S_xx) / 2,
    "Q3.2.3a": 1 - w**2,
}


@pytest.mark.parametrize("id", RIGHT_EXPRESSIONS)
def test_the_formulas_of_the_sheet_get_full_credit(marker, id):
    verdict = mark(marker, id, RIGHT_EXPRESSIONS[id])
    assert (verdict.status, verdict.points) == ("right", verdict.max_points)


def test_the_plain_arctan_is_right_for_the_derivation_with_a_note(marker):
    verdict = mark(marker, "Q2.2e", sp.atan(RATIO) / 2)
    assert "stationary angle" in verdict.feedback
    assert mark(marker, "Q2.2e", sp.atan2(-2 * S_xy, S_yy - S_xx) / 2).status == "right"


def test_the_plain_arctan_is_no_right_angle_of_the_minimum(marker):
    verdict = mark(marker, "Q2.2f2", sp.atan(RATIO) / 2)
    assert verdict.status == "partial"
    assert "S_yy < S_xx" in verdict.feedback


def test_the_angle_of_the_minimum_is_the_minimum_and_the_arctan_often_is_not():
    """By brute force over all angles, on random clouds of points."""
    rng = np.random.default_rng(2)
    angles = np.linspace(0, np.pi, 3601)
    formulas = [RIGHT_EXPRESSIONS[id] for id in ("Q2.2f2", "Q2.2e")]
    evaluated = sp.lambdify([S_xx, S_yy, S_xy], formulas)
    arctan_misses = 0
    for _ in range(60):
        x, y = rng.normal(0, rng.uniform(0.2, 3, 2), (30, 2)).T @ np.eye(30)
        x, y = x - x.mean(), y - y.mean()
        costs = (np.outer(np.cos(angles), x) + np.outer(np.sin(angles), y)) ** 2 @ np.ones(30)
        found, plain = evaluated(x @ x, y @ y, x @ y)
        at_found = float(np.sum((x * np.cos(found) + y * np.sin(found)) ** 2))
        at_plain = float(np.sum((x * np.cos(plain) + y * np.sin(plain)) ** 2))
        assert at_found <= min(costs) * (1 + 1e-9)
        arctan_misses += at_plain > min(costs) * 1.01
    assert 15 < arctan_misses < 45  # in about half of all data sets


# What students write instead, and words that the feedback must contain.
WRONG_EXPRESSIONS: dict[str, list[tuple[sp.Expr, str]]] = {
    "Q2.2a": [
        (n * r - sum_x * c - sum_y * s, "factor 2"),
        (2 * (r - sum_x * c - sum_y * s), "each point"),
        (2 * (r - x_c * c - y_c * s), "divided by N"),
        (2 * (n * r - x_c * c - y_c * s), "not their mean"),
        (-2 * (n * r - sum_x * c - sum_y * s), "sign"),
        (2 * n * r, "chain rule"),
        (2 * (n * r + sum_x * c + sum_y * s), "minus signs"),
    ],
    "Q2.2b": [
        (sum_x * c + sum_y * s, "number of points"),
        (x_c * s + y_c * c, "changed places"),
        (-x_c * c - y_c * s, "sign"),
        (x_c * c - y_c * s, "sine term"),
        (sp.sqrt(x_c**2 + y_c**2), "normal"),
    ],
    "Q2.2c": [
        (S_xx * c**2 + S_yy * s**2, "mixed term"),
        (S_xx * c**2 + S_xy * s * c + S_yy * s**2, "twice"),
        (S_xx * c**2 - 2 * S_xy * s * c + S_yy * s**2, "sign"),
        (COST.subs(alpha, sp.pi / 2 - alpha), "changed places"),
        (S_xx * c + 2 * S_xy * s * c + S_yy * s, "quare"),
    ],
    "Q2.2d": [
        (SLOPE / 2, "half of the derivative"),
        ((S_xx - S_yy) * sp.sin(2 * alpha) + 2 * S_xy * sp.cos(2 * alpha), "slope of cos"),
        ((S_yy - S_xx) * sp.sin(2 * alpha), "S_xy is missing"),
        ((S_yy - S_xx) * sp.sin(2 * alpha) + 2 * S_xy, "cos² minus sin²"),
        ((S_yy - S_xx) * sp.sin(2 * alpha) + S_xy * sp.cos(2 * alpha), "factor 2"),
        ((S_yy - S_xx) * sp.sin(2 * alpha) - 2 * S_xy * sp.cos(2 * alpha), "wrong sign"),
        (-SLOPE, "turned round"),
    ],
    "Q2.2e": [
        (sp.atan(RATIO), "Halve"),
        (sp.atan(-RATIO) / 2, "sign was lost"),
        (sp.atan2(2 * S_xy, S_yy - S_xx) / 2, "sign was lost"),
        (sp.atan(RATIO / 2) / 2, "2 in front of S_xy"),
        (sp.atan2(-S_xy, S_yy - S_xx) / 2, "2 in front of S_xy"),
        (sp.atan(1 / RATIO) / 2, "upside down"),
        (sp.atan(S_xy / S_xx), "slope m"),
    ],
    "Q2.2f1": [
        (CURVATURE / 2, "inner derivative"),
        (2 * (S_yy - S_xx) * sp.cos(2 * alpha) + 4 * S_xy * sp.sin(2 * alpha), "minus sign"),
        ((S_yy - S_xx) * sp.cos(2 * alpha) + 2 * S_xy * sp.sin(2 * alpha), "Two slips"),
        (SLOPE, "first derivative"),
        (-CURVATURE, "turned round"),
        (2 * (S_yy - S_xx) * sp.cos(2 * alpha), "S_xy is missing"),
    ],
    "Q2.2f2": [
        (sp.atan(RATIO) / 2, "this is the hill"),
        (sp.atan(RATIO) / 2 + sp.pi / 2, "Add it only where"),
        (sp.atan2(2 * S_xy, S_xx - S_yy) / 2, "on the hill, for every set"),
        (sp.atan2(-2 * S_xy, S_yy - S_xx), "Halve"),
        (sp.atan2(2 * S_xy, S_yy - S_xx) / 2, "leans the wrong way"),
        (sp.atan2(S_yy - S_xx, -2 * S_xy) / 2, "sine first"),
    ],
    "Q3.2.3a": [
        ((1 - w) ** 2, "both points are outliers"),
        (1 - w, "two points"),
        (w**2, "complement"),
        (2 * w * (1 - w), "exactly one outlier"),
        (1 - (1 - w) ** 2, "at least one inlier"),
        (1 - w**3, "three points"),
        (sp.Float("0.96"), "formula"),
    ],
}


@pytest.mark.parametrize("id", WRONG_EXPRESSIONS)
def test_every_typical_slip_in_an_expression_is_named(marker, id):
    found = set()
    for expression, words in WRONG_EXPRESSIONS[id]:
        for written in (expression, sp.expand(expression)):
            verdict = mark(marker, id, written)
            assert verdict.status in ("wrong", "partial"), expression
            assert verdict.alternative not in (None, "right"), expression
            assert words in verdict.feedback, expression
        found.add(verdict.alternative)
    keyed = {entry.name for entry in marker.course.key[id].alternatives if entry.is_mistake}
    assert found == keyed, "a keyed mistake is not tried here"


@pytest.mark.parametrize("id", WRONG_EXPRESSIONS)
def test_a_number_in_place_of_a_formula_earns_no_full_credit(marker, id):
    for value in (0, 1, sp.pi / 4, 0.96):
        assert mark(marker, id, value).credit < 1
