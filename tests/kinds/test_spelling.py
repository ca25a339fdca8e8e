"""Fields read what people type, or name the sign at fault with the right spelling."""

from __future__ import annotations

import math

import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from autograder.errors import UsageError
from autograder.kinds.expression.inside.typed_formula import read_expression
from autograder.kinds.expression.question import Expression
from autograder.questions.typed_number import read_number

NUMBERS = {"N": 1000, "w": 0.2, "p": 0.95, "x": 3, "alpha": 0.5}
FORMULA = Expression(
    id="Q1", chapter="c", title="t", prompt="p", hints=("h",), points=1.0, variable="f",
    symbols={"alpha": "an angle", "x": "a length", "S_xy": "a sum", "N": "a number"},
)  # fmt: skip


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("N(N-1)/2", 499500),
        ("2(3)", 6),
        ("(2)(3)", 6),
        ("2x", 6),
        ("2 x", 6),
        ("2π", 2 * math.pi),
        ("x (x + 1)", 12),
        ("(x+1)x", 12),
        ("499 500", 499500),
        ("499\u202f500", 499500),
        ("1 234 567.5", 1234567.5),
        ("499'500", 499500),
        ("1,234,567", 1234567),
        ("18%", 0.18),
        ("18 %", 0.18),
        ("100% - 18%", 0.82),
        ("ln(2)", math.log(2)),
        ("np.ceil(1.2)", 2),
        ("numpy.log(2)", math.log(2)),
        ("math.ceil(np.log(8)/np.log(2.5))", 3),
        ("arctan(1)", math.pi / 4),
        ("arctan2(1, 1)", math.pi / 4),
        ("sin^2(alpha)", math.sin(0.5) ** 2),
        ("sin²(α)", math.sin(0.5) ** 2),
        ("sin² α + cos² α", 1),
        ("2 sin(α) cos(α)", math.sin(1.0)),
        ("tan^-1(1)", math.pi / 4),
        ("tan⁻¹(1)", math.pi / 4),
        ("sin^(-1)(1)", math.pi / 2),
        ("2⋅3", 6),
        ("2×3∗4", 24),
        ("6÷3", 2),
        ("5 – 3", 2),
        ("5 − 3", 2),
        ("５００", 500),
        ("2³", 8),
        ("2^(-1)", 0.5),
        ("10⁻³", 0.001),
        ("x²", 9),
        ("½", 0.5),
        ("1½", 1.5),
        ("√2", math.sqrt(2)),
        ("√(x + 1)", 2),
        ("2√4", 4),
        ("[2 + 3]*2", 10),
        ("1/2*x", 1.5),
        ("1/(2x)", 1 / 6),
        ("log(1-p)/log(1-w^2)", math.log(0.05) / math.log(0.96)),
        ("1e-3", 0.001),
        ("2e3", 2000),
        ("2e", 2 * math.e),
        (".5x", 1.5),
        ("-x^2", -9),
        ("comb(5, 2)", 10),
        ("comb(1000,500) / comb(1000,500)", 1),
    ],
)
def test_what_is_plain_is_read(text: str, value: float):
    assert read_number(text, NUMBERS) == pytest.approx(value)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("1,500", "write 1500 or 1.500"),
        ("1/2x", "two meanings"),
        ("1/2(3)", "two meanings"),
        ("1/x(x+1)", "two meanings"),
        ("6:2", "/ for a division"),
        ("30°", "radians"),
        ("∞", "finite"),
        ("18 % x", "write 0.18"),
        ("12 34", "side by side"),
        ("sin 2 x", "Put its argument in brackets"),
        ("log^-1(2)", "1/log"),
        ("(1 + 2", "bracket is missing"),
        ("1 + 2)", "bracket is missing"),
        ("2 +", "not finished"),
        ("2^", "not finished"),
        ("x y", "y is not a number"),
        ("", "not finished"),
    ],
)
def test_what_is_not_plain_is_refused_with_the_right_spelling(text: str, said: str):
    with pytest.raises(UsageError) as caught:
        read_number(text, NUMBERS)
    assert said in str(caught.value)
    assert not str(caught.value).endswith("..")


@pytest.mark.parametrize(
    ("text", "same"),
    [
        ("N(N-1)/2", "N*(N-1)/2"),
        ("2 S_xy sin(2α)", "2*S_xy*sin(2*alpha)"),
        ("x² cos²(α)", "x**2*cos(alpha)**2"),
        ("½ arctan2(−2S_xy, x)", "atan2(-2*S_xy, x)/2"),
        ("tan^-1(x)", "atan(x)"),
        ("np.sin(alpha)·x", "sin(alpha)*x"),
        ("ln(x)", "log(x)"),
    ],
)
def test_formulas_are_read_the_same_way(text: str, same: str):
    names = {name: sp.Symbol(name, real=True) for name in FORMULA.symbols}
    assert sp.simplify(read_expression(FORMULA, text) - sp.sympify(same, locals=names)) == 0


@pytest.mark.parametrize(
    ("text", "said"), [("18% x", "0.18"), ("5!", "“!” is not understood"), ("x/2N", "two meanings")]
)
def test_formulas_are_refused_the_same_way(text: str, said: str):
    with pytest.raises(UsageError) as caught:
        read_expression(FORMULA, text)
    assert said in str(caught.value)


@given(st.text(alphabet="0123456789xNw+-*/^().,% '²½π√αsincotanlg|=", max_size=12))
def test_whatever_is_typed_is_a_number_or_one_sentence(text: str):
    said = ""
    try:
        assert isinstance(read_number(text, NUMBERS), int | float)
    except UsageError as error:
        said = str(error)
    assert not said or (said.endswith(".") and not said.endswith(".."))
