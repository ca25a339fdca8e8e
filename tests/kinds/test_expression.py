"""Expressions: any equal form is right, however it is written and whatever sympy assumes."""

import math
from functools import cache

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from autograder.kinds.expression.answer import ExpressionAlternative
from autograder.kinds.expression.marking import POINT_COUNT, matches
from autograder.marking import Mark
from autograder.marking.marker import Marker
from autograder.sandbox.inside.evaluate import evaluate
from tests.toy import Toy, make_toy

NAMES = "r alpha N x_c y_c sum_x sum_y S_xx S_yy S_xy w"


@pytest.fixture(scope="module")
def marker(request) -> Marker:
    return Marker(request.getfixturevalue("real_course"), seed=11)


def mark(marker: Marker, id: str, response: object) -> Mark:
    """Marked as the grader does it: evaluated over there, marked here."""
    return marker.mark(id, evaluate(response, marker.drawn(id).probe))


@cache
def right_forms(real: bool) -> dict[str, list[sp.Expr]]:
    """Right responses in several independent forms, for every expression of the sheet."""
    assumptions = {"real": True} if real else {}
    r, alpha, N, x_c, y_c, sum_x, sum_y, S_xx, S_yy, S_xy, w = sp.symbols(NAMES, **assumptions)
    c, s = sp.cos(alpha), sp.sin(alpha)
    # The sheet's derivation, differentiated by sympy.
    cost = S_xx * c**2 + 2 * S_xy * s * c + S_yy * s**2
    slope = sp.diff(cost, alpha)
    difference, root = S_yy - S_xx, sp.sqrt((S_yy - S_xx) ** 2 + 4 * S_xy**2)
    ratio = -2 * S_xy / difference
    by_cases = sp.Piecewise(
        (sp.atan(ratio) / 2, S_yy > S_xx), (sp.atan(ratio) / 2 + sp.pi / 2, True)
    )
    # tan(alpha) = sin(2 alpha) / (1 + cos(2 alpha))
    half_angle = sp.atan((-2 * S_xy) / (root + difference))
    t = (1 - c**2 + s**2) / 2  # sin² in disguise
    return {
        "Q2.2a": [
            2 * (N * r - sum_x * c - sum_y * s),
            2 * N * (r - x_c * c - y_c * s),
            sp.expand(2 * (N * r - N * x_c * c - sum_y * s)),
            2 * N * r - 2 * (sum_x * c + N * y_c * s),
        ],
        "Q2.2b": [
            x_c * c + y_c * s,
            (sum_x * c + sum_y * s) / N,
            x_c * c + sum_y * s / N,
            sp.sqrt(x_c**2 + y_c**2) * sp.cos(alpha - sp.atan2(y_c, x_c)),
        ],
        "Q2.2c": [
            cost,
            (S_xx + S_yy) / 2 + (S_xx - S_yy) / 2 * sp.cos(2 * alpha) + S_xy * sp.sin(2 * alpha),
            S_xx * (1 - t) + S_yy * t + S_xy * sp.sin(2 * alpha),
        ],
        "Q2.2d": [
            slope,
            difference * sp.sin(2 * alpha) + 2 * S_xy * sp.cos(2 * alpha),
            2 * difference * s * c + 2 * S_xy * (c**2 - s**2),
            2 * difference * s * c + 2 * S_xy * (1 - 2 * s**2),
        ],
        "Q2.2e": [
            sp.atan(ratio) / 2,
            sp.atan2(-2 * S_xy, difference) / 2,
            -sp.atan(2 * S_xy / difference) / 2,
            sp.atan(2 * S_xy / (S_xx - S_yy)) / 2 + sp.pi,
            by_cases,
            half_angle,
        ],
        "Q2.2f1": [
            sp.diff(slope, alpha),
            2 * difference * sp.cos(2 * alpha) - 4 * S_xy * sp.sin(2 * alpha),
            2 * difference * (2 * c**2 - 1) - 8 * S_xy * s * c,
        ],
        "Q2.2f2": [
            sp.atan2(-2 * S_xy, difference) / 2,
            sp.atan2(-2 * S_xy, difference) / 2 - 3 * sp.pi,
            by_cases,
            half_angle,
            sp.arg(difference - 2 * sp.I * S_xy) / 2,
        ],
        "Q3.2.3a": [1 - w**2, (1 - w) * (1 + w), 2 * w * (1 - w) + (1 - w) ** 2],
    }


FORMS = [
    pytest.param(id, form, id=f"{id}-{number}{'-real' if real else ''}")
    for real in (False, True)
    for id, forms in right_forms(real=real).items()
    for number, form in enumerate(forms)
]


@pytest.mark.parametrize(("id", "form"), FORMS)
def test_every_form_of_a_right_expression_is_right(marker, id, form):
    verdict = mark(marker, id, form)
    assert verdict.status == "right", verdict.feedback


REWRITINGS = {
    "expand": sp.expand,
    "expand_trig": sp.expand_trig,
    "factor": sp.factor,
    "simplify": sp.simplify,
    "trigsimp": sp.trigsimp,
    "together": sp.together,
    "as exponentials": lambda form: form.rewrite(sp.exp),
    "by tangents of half the angle": lambda form: form.rewrite(sp.tan),
    "evaluated numbers": lambda form: form.evalf(),
    "not evaluated": lambda form: sp.Add(form, 0, evaluate=False),
    "in a list": lambda form: [form],
    "as a set": lambda form: {form},
}


@pytest.mark.parametrize("rewriting", REWRITINGS)
@pytest.mark.parametrize("id", right_forms(real=False))
def test_rewriting_a_right_expression_leaves_it_right(marker, id, rewriting):
    forms = right_forms(real=True)[id][:1] + right_forms(real=False)[id][:1]
    for form in forms:
        verdict = mark(marker, id, REWRITINGS[rewriting](form))
        assert verdict.status == "right", verdict.feedback


def test_symbols_with_and_without_assumptions_may_be_mixed(marker):
    r = sp.Symbol("r", positive=True)
    alpha, other_alpha = sp.Symbol("alpha", real=True), sp.Symbol("alpha")
    N, x_c, sum_y = sp.Symbol("N", integer=True), sp.Symbol("x_c"), sp.Symbol("sum_y", real=True)
    form = 2 * (N * r - N * x_c * sp.cos(alpha) - sum_y * sp.sin(other_alpha))
    assert mark(marker, "Q2.2a", form).status == "right"


def test_what_sympy_solves_itself_is_right(marker):
    """Both stationary angles in one half-turn solve it; solve() gives forms of its own."""
    alpha, S_xx, S_yy, S_xy = sp.symbols("alpha S_xx S_yy S_xy", real=True)
    r, N, sum_x, sum_y = sp.symbols("r N sum_x sum_y")
    slope_in_r = 2 * (N * r - sum_x * sp.cos(alpha) - sum_y * sp.sin(alpha))
    assert mark(marker, "Q2.2b", sp.solve(slope_in_r, r)).status == "right"
    angle = sp.solve(sp.Eq(sp.tan(2 * alpha), -2 * S_xy / (S_yy - S_xx)), alpha)
    assert mark(marker, "Q2.2e", angle[0]).credit == 1


def test_all_the_turns_of_an_angle_are_right_together(marker):
    n, S_xx, S_yy, S_xy = sp.symbols("n S_xx S_yy S_xy")
    angle = sp.atan2(-2 * S_xy, S_yy - S_xx) / 2
    quarters = sp.ImageSet(sp.Lambda(n, angle + n * sp.pi / 2), sp.S.Integers)
    halves = sp.ImageSet(sp.Lambda(n, angle + n * sp.pi), sp.S.Integers)
    eighths = sp.ImageSet(sp.Lambda(n, angle + n * sp.pi / 4), sp.S.Integers)
    assert [mark(marker, "Q2.2e", turns).credit for turns in (quarters, halves)] == [1, 1]
    assert mark(marker, "Q2.2e", eighths).credit < 1
    assert mark(marker, "Q2.2f2", halves).status == "right"
    assert mark(marker, "Q2.2f2", quarters).credit < 1


@pytest.mark.parametrize("pi", [3.14, 3.1416, 3.14159])
def test_a_rounded_pi_is_wrong_and_told_so(marker, pi):
    S_xx, S_yy, S_xy = sp.symbols("S_xx S_yy S_xy")
    angle = sp.atan2(-2 * S_xy, S_yy - S_xx) / 2
    for response in (angle + pi, sp.atan2(2 * S_xy, S_xx - S_yy) / 2 + pi / 2):
        verdict = mark(marker, "Q2.2f2", response)
        assert (verdict.status, verdict.alternative) == ("wrong", "a rounded number")
        assert "a number in it was rounded" in verdict.feedback
    assert mark(marker, "Q2.2f2", angle + math.pi).status == "right"
    assert mark(marker, "Q2.2f2", angle + 3.1).alternative != "a rounded number"


def test_a_result_that_still_depends_on_r_is_told_so(marker):
    r, alpha, N, sum_x, sum_y = sp.symbols("r alpha N sum_x sum_y")
    form = (sum_x * sp.cos(alpha) + sum_y * sp.sin(alpha)) / N + (r - sp.cos(r)) / 1000
    verdict = mark(marker, "Q2.2b", form)
    assert (verdict.status, verdict.alternative) == ("wrong", "depends on r")
    assert "still depends on r" in verdict.feedback
    # An r that cancels is none.
    assert mark(marker, "Q2.2b", form - (r - sp.cos(r)) / 1000).status == "right"


@pytest.mark.parametrize(
    ("response", "said"),
    [
        ("2*(a + b)", "a string; write it without quotes"),
        (lambda a, b: 2 * (a + b), "function"),
        (sp.Eq(sp.Symbol("rim"), sp.Symbol("a")), "only the side that is asked for"),
        ([], "it is empty"),
        (sp.S.EmptySet, "it is empty"),
        (sp.Interval(0, 1), "it is a set"),
        (sp.ImageSet(sp.Lambda(sp.Symbol("n"), sp.Symbol("n")), sp.S.Reals), "it is a set"),
        (2 * sp.Symbol("c"), "does not declare (it declares a, b, half)"),
        (sp.Symbol("a") > 0, "not a sympy expression"),
        (sp.Matrix([1, 2]), "several values"),
        ({sp.Symbol("rim"): sp.Symbol("a"), sp.Symbol("b"): 0}, "several values"),
        ({sp.Symbol("a"): 2 * (sp.Symbol("a") + sp.Symbol("b"))}, "not a sympy expression"),
        ({"rim": sp.Symbol("a")}, "not a sympy expression"),
        (None, "not a sympy expression"),
    ],
)
def test_what_is_no_expression_is_wrong_and_told_why(toy, response, said):
    verdict = mark(Marker(toy.load(), seed=1), "Q1.4", response)
    assert (verdict.status, verdict.alternative) == ("wrong", "not usable")
    assert said in verdict.feedback


A, B, HALF = sp.symbols("a b half")
RIM = sp.Symbol("rim")


@pytest.mark.parametrize(
    "solved",
    [
        sp.solve(RIM - 2 * (A + B), RIM),
        sp.solve(RIM - 2 * (A + B), RIM, dict=True),
        sp.solve([RIM - 2 * (A + B)], [RIM]),
        sp.solveset(RIM - 2 * (A + B), RIM),
        sp.solveset(RIM - 2 * (A + B), RIM, sp.S.Reals),
        sp.solveset(RIM * (A - B) - 2 * (A + B) * (A - B), RIM),
        sp.solve(RIM - 2 * (A + B), RIM, set=True),
        sp.ConditionSet(RIM, sp.Gt(A, 0), sp.FiniteSet(2 * (A + B))),
        sp.Union(sp.FiniteSet(2 * HALF), sp.FiniteSet(2 * (A + B))),
        sp.Union(sp.FiniteSet(2 * HALF), sp.ImageSet(sp.Lambda(RIM, 2 * (A + B)), sp.S.Integers)),
        {2 * (A + B), 2 * HALF},
        np.array([2 * (A + B), 2 * HALF]),
        sp.linsolve([RIM - 2 * (A + B)], RIM),
        [{RIM: 2 * (A + B)}, {RIM: 4 * HALF / 2}],
        [sp.Matrix([2 * (A + B)])],
    ],
    ids=lambda solved: type(solved).__name__,  # a set prints in another order in each worker
)
def test_whatever_form_sympy_gives_a_solution_in_is_right(toy, solved):
    assert mark(Marker(toy.load(), seed=1), "Q1.4", solved).status == "right"


@pytest.mark.parametrize(
    ("response", "status", "credit", "alternative"),
    [
        (2 * (A + B), "right", 1, "right"),
        (2 * HALF, "right", 1, "right"),
        (A + B + HALF, "right", 1, "right"),
        (HALF, "partial", 0.5, "half the rim"),
        (A * B, "wrong", 0, "the area"),
        (A - B, "wrong", 0, None),
        (sp.Integer(12), "wrong", 0, None),
        (12, "wrong", 0, None),
        (2 * (A + B) * (1 + sp.Float("1e-12")), "right", 1, "right"),
        (2 * (A + B) * (1 + sp.Float("1e-5")), "wrong", 0, "a rounded number"),
        (2 * (A + B) * (1 + sp.Float("6e-3")), "wrong", 0, None),
        (2 * (A + B) + sp.I, "wrong", 0, None),
        (2 * (A + B) + 0 * sp.log(-1), "right", 1, "right"),
        (sp.log(-A) + 2 * (A + B), "wrong", 0, None),
        (sp.zoo, "wrong", 0, None),
        (sp.nan, "wrong", 0, None),
        (sp.oo, "wrong", 0, None),
        (sp.Sum(A + B, (sp.Symbol("i"), 1, 2)), "right", 1, "right"),
        (sp.Integral(4 * sp.Symbol("x"), (sp.Symbol("x"), 0, 1)) * HALF, "right", 1, "right"),
    ],
)
def test_statuses_and_credits_of_the_toy_course(toy, response, status, credit, alternative):
    verdict = mark(Marker(toy.load(), seed=1), "Q1.4", response)
    assert (verdict.status, verdict.credit, verdict.alternative) == (status, credit, alternative)
    assert verdict.points == 4 * credit


def test_a_stub_is_not_attempted(toy):
    assert mark(Marker(toy.load(), seed=1), "Q1.4", ...).status == "not attempted"


def test_no_answer_is_in_what_is_sent(toy):
    """Points only: the values of the right expression stay on the trusted side."""
    sent = Marker(toy.load(), seed=1).drawn("Q1.4").probe
    assert sent.keys() == {"kind", "points"}
    assert sent["points"].keys() == {"a", "b", "half"}


@settings(max_examples=30)
@given(
    seed=st.integers(0, 10**6),
    numbers=st.lists(st.integers(-3, 3), min_size=4, max_size=4),
)
def test_equal_polynomials_match_and_different_ones_do_not(rim_course, seed, numbers):
    """Any polynomial in a and b, expanded or not, against the rim's 2a + 2b."""
    p, q, r, s = numbers
    form = 2 * A + 2 * B + (p * A + q) * (r * B + s)
    marker = Marker(rim_course.load(), seed)
    equal = sp.expand(form) == 2 * A + 2 * B
    for written in (form, sp.expand(form), sp.factor(form)):
        assert (mark(marker, "Q1.4", written).status == "right") == equal


@pytest.fixture(scope="module")
def rim_course(tmp_path_factory) -> Toy:
    return make_toy(tmp_path_factory.mktemp("course"))


def alternative(expression: str, modulo: str | None = None) -> ExpressionAlternative:
    return ExpressionAlternative(name="x", credit=1.0, expression=expression, modulo=modulo)


ANGLES = {"x": np.linspace(-3.0, 3.0, 2 * POINT_COUNT)}


@given(st.lists(st.integers(-4, 4), min_size=2 * POINT_COUNT, max_size=2 * POINT_COUNT))
def test_whole_turns_do_not_matter_where_the_key_says_so(turns):
    values = ANGLES["x"] + math.pi * np.array(turns) + 0j
    assert matches(alternative("x", modulo="pi"), ANGLES, values)
    assert matches(alternative("x"), ANGLES, values) == (not any(turns))


@given(st.floats(0.01, 0.49), st.integers(0, 2 * POINT_COUNT - 1))
def test_a_part_of_a_turn_matters_at_any_point(part, at):
    values = ANGLES["x"] + 0j
    values[at] += math.pi * part
    assert not matches(alternative("x", modulo="pi"), ANGLES, values)


def test_points_where_the_key_is_undefined_do_not_count():
    values = np.where(ANGLES["x"] > 0, np.sqrt(np.abs(ANGLES["x"])), 77.0) + 0j
    assert matches(alternative("sqrt(x)"), ANGLES, values)
    values[-1] += 1e-3
    assert not matches(alternative("sqrt(x)"), ANGLES, values)


def test_a_key_that_is_hardly_defined_anywhere_matches_nothing():
    assert not matches(alternative("sqrt(x - 2.9)"), ANGLES, np.zeros(2 * POINT_COUNT) + 0j)
