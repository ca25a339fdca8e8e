"""The key's formulas: plain arithmetic, as Python and NumPy compute it, and nothing else."""

import contextlib
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.errors import CourseError
from autograder.questions.key_formulas import evaluate_formula

X = np.array([-2.5, -1.0, 0.5, 3.0])
Y = np.array([0.25, 4.0, -1.5, 2.0])


def value(text: str, **values: float) -> float:
    return float(evaluate_formula(text, values))


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1 + 2*3", 7),
        ("(1 + 2)*3", 9),
        ("2**3**2", 512),  # a power binds from the right
        ("-2**2", -4),
        ("7/2", 3.5),
        ("1e3 - .5", 999.5),
        ("+3 - -4", 7),
        ("sqrt(2)", math.sqrt(2)),
        ("atan2(-1, -1)", -3 * math.pi / 4),
        ("atan(1)", math.pi / 4),
        ("asin(1) + acos(1)", math.pi / 2),
        ("tan(pi/4)", 1),
        ("log(e)", 1),
        ("exp(0) + abs(-2)", 3),
        ("floor(-1.5) + ceil(1.2)", 0),
        ("where(2 > 1, 10, 20)", 10),
        ("where(2 <= 1, 10, 20)", 20),
        (" 1\n", 1),
    ],
)
def test_a_formula_without_names_has_the_value_of_the_arithmetic(text, expected):
    assert value(text) == pytest.approx(expected, rel=1e-15)


def test_names_stand_for_arrays_elementwise():
    values = evaluate_formula("2*x - y/(1 + x**2)", {"x": X, "y": Y})
    assert values == pytest.approx([2 * x - y / (1 + x * x) for x, y in zip(X, Y, strict=True)])


def test_where_chooses_for_each_element():
    values = evaluate_formula("where(x < y, x, y)", {"x": X, "y": Y})
    assert values.tolist() == [min(pair) for pair in zip(X, Y, strict=True)]


def test_a_value_takes_the_place_of_a_constant_of_the_same_name():
    assert value("2*e", e=5.0) == 10.0


number = st.floats(-1e3, 1e3, allow_nan=False).map(lambda x: round(x, 3))


@st.composite
def formulas(draw: st.DrawFn, depth: int = 3) -> str:
    """Text that is both Python and a formula, in the names x and y."""
    if depth == 0 or draw(st.booleans()):
        return draw(st.sampled_from(["x", "y", "pi"]) | number.map(str))
    left, right = draw(formulas(depth=depth - 1)), draw(formulas(depth=depth - 1))
    form = draw(
        st.sampled_from(
            [
                "({} + {})",
                "({} - {})",
                "{} * {}",
                "(-({}) + {})",
                "atan2({}, {})",
                "sin({})*cos({})",
            ]
        )
    )
    return form.format(f"({left})", f"({right})")


@given(formulas(), number, number)
def test_any_formula_agrees_with_python(text, x, y):
    names = {"sin": math.sin, "cos": math.cos, "atan2": math.atan2, "pi": math.pi}
    expected = eval(text, {"__builtins__": {}}, {**names, "x": x, "y": y})
    assert value(text, x=x, y=y) == pytest.approx(expected, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize(
    ("text", "finite"),
    [
        ("1/0", False),
        ("0/0", False),
        ("log(0)", False),
        ("log(-1)", False),
        ("(-8)**0.5", False),
        ("9**9**9", False),
        ("x/(x - 3)", False),
        ("x/(x - 2)", True),
    ],
)
def test_what_is_undefined_is_nan_or_infinite_and_no_warning(text, finite, recwarn):
    assert bool(np.isfinite(value(text, x=3.0))) == finite
    assert not recwarn.list


REFUSED = [
    "x.real",
    "().__class__.__bases__",
    "__import__('os')",
    "open('key.toml')",
    "eval('1')",
    "sin.__call__(1)",
    "lambda: 1",
    "(lambda x: x)(1)",
    "[1, 2]",
    "(1, 2)",
    "{1: 2}",
    "[x for x in (1, 2)]",
    "x[0]",
    "'text'",
    "b'bytes'",
    "f'{x}'",
    "True",
    "None",
    "...",
    "1j",
    "x if x else y",
    "x and y",
    "not x",
    "~x",
    "x // y",
    "x % y",
    "x @ y",
    "x << 2",
    "1 < x < 2",
    "x == y",
    "x is y",
    "x in y",
    "(x := 2)",
    "sin(x=1)",
    "sin(*x)",
    "sin(**x)",
    "sin(1, 2, 3)",
    "sin()",
    "atan2(1)",
    "where(1 < 2)",
    "where(1 < 2, 3)",
    "x = 1",
    "x; y",
    "import os",
    "del x",
    "await x",
    "yield",
    "unknown + 1",
    "sin",
    "unknown(1)",
    "2 x",
    "2(3)",
    "(1",
    "",
    "   ",
    "\0",
    "1\n2",
    "-(x < y)",
    "1" * 5000,
    "(" * 500 + "1" + ")" * 500,
    "-" * 50_000 + "1",
    "+".join(["1"] * 50_000),
]


@pytest.mark.parametrize("text", REFUSED, ids=lambda text: repr(text[:20]))
def test_anything_that_is_no_arithmetic_is_refused_in_one_short_sentence(text):
    with pytest.raises(CourseError) as refused:
        evaluate_formula(text, {"x": 1.0, "y": 2.0})
    sentence = str(refused.value)
    assert sentence.endswith(".")
    assert len(sentence) < 400


@given(st.text(max_size=40))
def test_no_text_at_all_makes_it_fail_in_another_way(text):
    with contextlib.suppress(CourseError):
        evaluate_formula(text, {"x": X})


def test_the_sentence_names_the_formula_and_the_name_without_a_value():
    with pytest.raises(CourseError, match=r"'2\*z' uses 'z', which has no value"):
        evaluate_formula("2*z", {"x": 1.0})
