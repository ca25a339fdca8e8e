"""Numbers and formulas typed into a field."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
import sympy as sp

from autograder.errors import UsageError
from autograder.kinds.expression.inside.typed_formula import read_expression
from autograder.kinds.expression.question import Expression
from autograder.kinds.number.question import Number
from autograder.kinds.true_false.question import TrueFalse
from autograder.questions.registry import kind_of
from autograder.questions.typed_number import read_number

COMMON = {"id": "Q1", "chapter": "c", "title": "t", "prompt": "p", "hints": ("h",)}
WORTH = {**COMMON, "points": 1.0}
NUMBER = Number(**WORTH, variable="area", integer=True)
FORMULA = Expression(**WORTH, variable="hedge", symbols={"w": "width", "l": "length"})


def cell_for(question, response):
    return kind_of(question).typed_cell(question, response)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("12", 12),
        (" 3 * 4 ", 12),
        ("2^3", 8),
        ("-1/4", -0.25),
        ("ceil(log(8) / log(2.5))", 3),
        ("comb(5, 2)", 10),
        ("math.sqrt(16)", 4),
        ("pi", math.pi),
        ("n - 1", 9),
        ("1e-3", 0.001),
    ],
)
def test_a_number_is_read(text: str, value: float):
    assert read_number(text, {"n": 10}) == pytest.approx(value)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "not finished"),
        ("12 +", "not finished"),
        ("(1 + 2", "bracket is missing"),
        ("area = 12", "without an equals sign"),
        ("1,2,3", "one value"),
        ("a", "a is not a number"),
        ("1/0", "no value"),
        ("log(-1)", "no value"),
        ("9**9**9**9", "too large"),
        ("comb(10**9, 5)", "too large"),
        ("1e400", "finite"),
        ("True", "True is not a number"),
        ("'12'", "not understood"),
        ("__import__('os').system('true')", "not understood"),
        ("(lambda: 1)()", "not understood"),
        ("[1][0]", "not understood"),
        ("x.__class__", "not understood"),
        ("1" * 600, "longer"),
    ],
)
def test_what_is_no_number_is_refused_with_a_reason(text: str, said: str):
    with pytest.raises(UsageError, match=said):
        read_number(text, {"x": "text"})


@pytest.mark.parametrize(
    "text",
    ["2*w + 2*l", "2*(w+l)", "sqrt(4)*w + l*2", "2*w - -2*l", "2·w + sp.sqrt(4)*l"],
)
def test_a_formula_is_read_in_the_declared_symbols(text: str):
    w, length = sp.symbols("w l", real=True)
    assert sp.simplify(read_expression(FORMULA, text) - 2 * (w + length)) == 0


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("2*h", "h is not one of the symbols here: w, l"),
        ("w.subs(l, 3)", "not understood"),
        ("w = l", "without an equals sign"),
        ("w**10**9", "too large"),
        ("eval('1')", "not understood"),
    ],
)
def test_what_is_no_formula_is_refused_with_a_reason(text: str, said: str):
    with pytest.raises(UsageError, match=said):
        read_expression(FORMULA, text)


def test_the_cell_for_the_grader_fills_in_what_the_notebook_left_open(
    orchard_template: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setenv("AUTOGRADER_COURSE", str(orchard_template))
    formula = Expression(**WORTH | {"id": "Q3"}, variable="hedge", symbols=FORMULA.symbols)
    cells = [cell_for(NUMBER, 12), cell_for(formula, "2*w")]
    left_open = {"area": ..., "other": 1}
    for cell in cells:
        exec(str(cell), left_open)
    assert left_open["area"] == 12
    assert str(left_open["hedge"]) == "2*w"
    assigned = {"area": 3, "hedge": 4}
    for cell in cells:
        exec(str(cell), assigned)
    assert (assigned["area"], assigned["hedge"]) == (3, 4)


@pytest.mark.parametrize("response", [None, True, "12", [1], {"a": 1}])
def test_nothing_else_becomes_a_cell(response: object):
    assert cell_for(NUMBER, response) is None
    assert cell_for(TrueFalse(**COMMON, statements=("a",)), response) is None


def test_what_a_file_says_was_typed_cannot_run(orchard_template: Path, monkeypatch):
    monkeypatch.setenv("AUTOGRADER_COURSE", str(orchard_template))
    formula = Expression(**WORTH | {"id": "Q3"}, variable="hedge", symbols=FORMULA.symbols)
    namespace: dict[str, object] = {}
    exec(str(cell_for(formula, "'); raise SystemExit('")), namespace)
    assert namespace["hedge"] is ...
