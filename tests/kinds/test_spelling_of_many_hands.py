"""What other hands type: decimal commas, LaTeX, other alphabets, typing errors, units."""

from __future__ import annotations

import math

import pytest
import sympy as sp

from autograder.errors import UsageError
from autograder.kinds.expression.inside.typed_formula import read_expression
from autograder.kinds.expression.question import Expression
from autograder.kinds.number.question import Number
from autograder.questions.registry import kind_of
from autograder.questions.typed_number import read_number
from autograder.student.widgets.prediction import _number as read_prediction

NUMBERS = {"N": 1000, "w": 0.2, "p": 0.95}
COMMON = {"id": "Q1", "chapter": "c", "title": "t", "prompt": "p", "hints": ("h",), "points": 1.0}
SYMBOLS = {"alpha": "an angle", "S_xx": "a sum", "S_xy": "a sum", "N": "a number", "w": "a share"}
FORMULA = Expression(**COMMON, variable="f", symbols=SYMBOLS)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        # Decimal commas and points of thousands.
        ("0,18", 0.18),
        ("-0,18", -0.18),
        ("0,180", 0.18),
        ("1,2345", 1.2345),
        ("12,34", 12.34),
        ("98,31 %", 0.9831),
        ("1.234,56", 1234.56),
        ("1,234.56", 1234.56),
        ("1'234,56", 1234.56),
        ("1.000.000", 1_000_000),
        ("1_000", 1000),
        ("1-0,96^42", 1 - 0.96**42),
        ("(1-0,2^2)^42", 0.96**42),
        ("ln(0,05)/ln(0,96)", math.log(0.05) / math.log(0.96)),
        ("log(0,05)/log(0,96)", math.log(0.05) / math.log(0.96)),
        ("1,8·10^-1", 0.18),
        ("1.8 × 10⁻¹", 0.18),
        ("1.8 × 10 − 1", 17),
        ("2*10-1", 19),
        ("atan2(0,5; 1)", math.atan2(0.5, 1)),
        ("comb(1000,2)", 499500),
        ("round(0.18003, 2)", 0.18),
        # What stands around.
        ("= 74", 74),
        ("1-0.96^42 =", 1 - 0.96**42),
        ("0.18.", 0.18),
        ("74;", 74),
        ("499500.", 499500),
        ("$74$", 74),
        ("`74`", 74),
        ("\\(74\\)", 74),
        ("\u200b74\ufeff", 74),
        ("012", 12),
        # Words and signs.
        ("98.31 percent", 0.9831),
        ("18 Prozent", 0.18),
        ("18‰", 0.018),
        ("N!/(2!(N-2)!)", 499500),
        ("5!", 120),
        ("C(1000, 2)", 499500),
        ("pow(2, 10)", 1024),
        ("⌈log(1-p)/log(1-w²)⌉", 74),
        ("⌊73.38⌋", 73),
        ("|-3|", 3),
        ("1000 x 999 / 2", 499500),
        ("1000x999/2", 499500),
        ("N x (N-1)/2", 499500),
        ("1.8x10^-1", 0.18),
        ("LN(0.05)/Log(0.96)", math.log(0.05) / math.log(0.96)),
        ("lg(100)", 2),
        ("log_10(100)", 2),
        ("log₁₀ 100", 2),
        ("2*Pi", 2 * math.pi),
        ("√sin(1)", math.sqrt(math.sin(1))),
        ("sin 1 cos 1", math.sin(1) * math.cos(1)),
        ("2^²", 4),
        ("¹⁄₂", 0.5),
        ("1½ π", 1.5 * math.pi),
        ("sin ½", math.sin(0.5)),
        # LaTeX.
        (r"\frac{N(N-1)}{2}", 499500),
        (r"\dfrac12 \cdot 3", 1.5),
        (r"\binom{N}{2}", 499500),
        (r"$\left\lceil\frac{\ln(1-p)}{\ln(1-w^{2})}\right\rceil$", 74),
        (r"\sqrt{16}", 4),
        # Other alphabets.
        ("٤٢", 42),
        ("۵٫۵", 5.5),
        ("१२३", 123),
        ("１，５", 1.5),
    ],
)
def test_numbers_of_many_hands_are_read(text: str, value: float):
    assert read_number(text, NUMBERS) == pytest.approx(value)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        # Each of these was read as another number before.
        ("0.18 (18 %)", "two meanings"),
        ("74 (73.38)", "two meanings"),
        ("1.2.3", "more than one point"),
        ("0. 18", "side by side at “0. 18”"),
        ("0·18", "write 0.18 or 0*18"),
        ("1.8 × 10−1", "write 1.8*10^-1 or 1.8*10 - 1"),
        ("1,8·10-1", "write 1,8*10^-1 or 1,8*10 - 1"),
        ("2x10–3", "write 2*10^-3 or 2*10 - 3"),
        ("3 ¾", "write 3 + 3/4 or 3*3/4"),
        ("(w+1)2", "write (w + 1)*2 or (w + 1)**2"),
        ("sin ½N", "sin((1/2)*N)"),
        ("1.5½", "two meanings"),
        ("w 2", "write w*2 or w**2"),
        # The sign at fault is named.
        ("log(8,2)", "write log(8.2) or log(8, 2)"),
        ("1,500", "write 1500 or 1.500"),
        ("[1,2]", "one value"),
        ("~0.18", "“~”"),
        ("0.9831...", "“…”"),
        ("73.38 → 74", "“→”"),
        ("> 73", "“>”"),
        ("74?", "“?”"),
        ("90º", "“°” is not understood here; write the angle"),
        ("„74“", "without quotes"),
        ("18 v.H.", "v is not a number here"),
        ("3!!", "“!!” has two meanings"),
        ("N!", "too large"),
        ("N*(N-1)//2", "“//” is not understood here; write / for a division"),
        ("0.18+/-0.01", "“±”"),
        ("74+", "nothing follows “+”"),
        ("2^", "nothing follows “^”"),
        ("*74", "nothing stands before “*”"),
        ("()", "brackets are empty"),
        ("((74)", "add “)”"),
        ("74)", "add “(”"),
        ("∛8", "x**(1/3)"),
        ("N.(N-1)", "a point only between digits"),
        (r"\foo{1}", r"“\foo”"),
        (r"\frac{1}", "comb"),
        ("0˙18", "“˙”"),
        # And the word.
        ("1000 choose 2", "comb(n, k)"),
        ("0.96 hoch 42", "x**2"),
        ("45 degrees", "radians"),
        ("ca. 0.18", "ca is not a number here"),
        ("1-P", "perhaps p is meant"),
        ("0x10", "x10 is not a number"),
        ("roundup(73.38)", "roundup is not understood; use abs"),
        ("comb(5)", "comb takes other arguments"),
        ("sin -1", "Put the argument of sin in brackets"),
    ],
)
def test_what_could_be_misread_is_refused(text: str, said: str):
    with pytest.raises(UsageError) as caught:
        read_number(text, NUMBERS)
    assert said in str(caught.value)
    assert not str(caught.value).endswith("..")
    assert "no value: " not in str(caught.value)  # one sentence, not two in one


@pytest.mark.parametrize(
    ("text", "same"),
    [
        (r"\frac{1}{2}\arctan\left(\frac{2S_{xy}}{S_{xx}}\right)", "atan(2*S_xy/S_xx)/2"),
        (r"\frac12\operatorname{atan2}(-2S_{xy}, S_{xx})", "atan2(-2*S_xy, S_xx)/2"),
        (r"2\,S_{xy}\cos(2\alpha)", "2*S_xy*cos(2*alpha)"),
        (r"\sin^{2}{\alpha}", "sin(alpha)**2"),
        ("½·atan2(-2 S_xy; S_xx)", "atan2(-2*S_xy, S_xx)/2"),
        ("0,5*S_xx", "S_xx/2"),
        ("2 sin α cos α", "sin(2*alpha)"),
        ("sin α / cos α", "tan(alpha)"),
        ("cos α * w / N", "cos(alpha)*w/N"),
        ("√2/2*w", "sqrt(2)*w/2"),
        ("sin(𝛼)", "sin(alpha)"),
        ("Sxx + Sxy", "S_xx + S_xy"),
        ("S_{xx}", "S_xx"),
        ("ArcTan[2 S_xy/S_xx]", "atan(2*S_xy/S_xx)"),
        ("1 - w x w", "1 - w**2"),
        ("S_\u0445\u0445", "S_xx"),  # Cyrillic
        ("1-w^2.", "1 - w**2"),
        ("|S_xy|", "Abs(S_xy)"),
    ],
)
def test_formulas_of_many_hands_are_read(text: str, same: str):
    names = {name: sp.Symbol(name, real=True) for name in SYMBOLS}
    assert sp.simplify(read_expression(FORMULA, text) - sp.sympify(same, locals=names)) == 0


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("α₁", "alpha1 is not one of the symbols"),
        ("α2", "alpha2 is not one of the symbols"),
        ("sin2α", "write sin(2*x) or sin(x)**2"),
        ("sin 2α", "sin(2*alpha)"),
        ("sinalpha", "sin(alpha)"),
        ("sin α²", "write sin(alpha**(...)) or sin(alpha)**(...)"),
        ("√w^2", "write sqrt(w**2) or sqrt(w)**2"),
        ("S_xx sin 2*alpha", "write sin(2*alpha) or sin(2)*alpha"),
        ("cos π/4", "write cos(pi/4) or cos(pi)/4"),
        ("ln 1/2", "write log(1/2) or log(1)/2"),
        ("1/2 sin(α)", "/ 2*sin(...) or / (2*sin(...))"),
        ("S_xx 2", "S_xx*2 or S_xx**2"),
        ("S_xx'", "quotes"),
        ("1-w^2%", "behind a number"),
        ("S_xx/0", "divides by zero"),
        ("0/0*S_xx", "divides by zero"),
        ("w̄", "w̄ is not one of the symbols"),
        (r"\bar{w}", r"“\bar”"),
        ("sin(α)  # half", "“#”"),
        ("arccot(α)", "arccot is not understood; use"),
    ],
)
def test_formulas_that_could_be_misread_are_refused(text: str, said: str):
    with pytest.raises(UsageError) as caught:
        read_expression(FORMULA, text)
    assert said in str(caught.value)
    assert not str(caught.value).endswith("..")


@pytest.mark.parametrize(
    "text", ["74 iterations", "74 Iteration", "74iterations.", "(74) iterations"]
)
def test_the_question_s_own_unit_may_stand_behind_the_number(text: str):
    question = Number(
        **COMMON, variable="k", integer=True, unit="iterations", unit_of_one="iteration"
    )
    assert kind_of(question).read_typed(question, text, {})[0] == 74


@pytest.mark.parametrize(
    ("text", "value"),
    [("50%", 50), ("50 %.", 50), ("50 Prozent", 50), ("0,5", 0.5), ("10^4", 1e4), ("sqrt(4)", 2)],
)
def test_predictions_are_read_the_same_way(text: str, value: float):
    assert read_prediction(text) == value


def test_a_prediction_that_is_refused_says_one_sentence():
    with pytest.raises(UsageError, match=r"^This is not finished: nothing follows “\*”\.$"):
        read_prediction("3*")
