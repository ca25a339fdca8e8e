"""Wrong formulas that a right one is turned into, to give a wrong expression its name."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

from autograder.kinds.expression.slopes import slopes
from autograder.kinds.expression.wrong_throughout import terms, wholes
from autograder.questions.key_formulas import evaluate_formula


@pytest.mark.parametrize(
    ("formula", "symbols", "wrong"),
    [
        (
            "a*sin(2*b)**2 + cos(b) - atan2(b, c)/2",
            "abcd",
            {
                "sine and cosine exchanged": ["a*cos(2*b)**2 + sin(b) - atan2(b, c)/2"],
                "the single angle": ["a*sin(b)**2 + cos(b) - atan2(b, c)/2"],
                "the double angle": ["a*sin(2*(2*b))**2 + cos(2*b) - atan2(b, c)/2"],
                "an angle in degrees": [
                    "a*sin(180/pi*(2*b))**2 + cos(180/pi*b) - atan2(b, c)/2"
                ],
                "an angle taken for degrees": [
                    "a*sin(pi/180*(2*b))**2 + cos(pi/180*b) - atan2(b, c)/2"
                ],
                "sine and cosine left out": ["a*1**2 + 1 - atan2(b, c)/2"],
                "powers left out": ["a*sin(2*b) + cos(b) - atan2(b, c)/2"],
                "not solved for the angle": [
                    "a*sin(2*b)**2 + cos(b) - b/c",
                    "a*sin(2*b)**2 + cos(b) - b/c/2",
                ],
                "the tangent for its inverse": ["a*sin(2*b)**2 + cos(b) - tan(b/c)/2"],
                "a and b exchanged": ["b*sin(2*a)**2 + cos(a) - atan2(a, c)/2"],
                "a and c exchanged": ["c*sin(2*b)**2 + cos(b) - atan2(b, a)/2"],
                "b and c exchanged": ["a*sin(2*c)**2 + cos(c) - atan2(c, b)/2"],
            },
        ),
        (
            " tan(x) + sin(3*x)*x**y",
            "xy",
            {
                "sine and cosine exchanged": ["tan(x) + cos(3*x)*x**y"],
                "the double angle": ["tan(2*x) + sin(2*(3*x))*x**y"],
                "an angle in degrees": ["tan(180/pi*x) + sin(180/pi*(3*x))*x**y"],
                "an angle taken for degrees": ["tan(pi/180*x) + sin(pi/180*(3*x))*x**y"],
                "sine and cosine left out": ["1 + 1*x**y"],
                "x and y exchanged": ["tan(y) + sin(3*y)*y**x"],
            },
        ),
        (
            "2*atan2(a, b)",  # what stands in front of the angle stays
            "ab",
            {
                "not solved for the angle": ["2*(a/b)"],
                "the tangent for its inverse": ["2*tan(a/b)"],
                "a and b exchanged": ["2*atan2(b, a)"],
            },
        ),
        (
            "atan2(a, b)*2",
            "ab",
            {
                "not solved for the angle": ["a/b", "a/b*2"],
                "the tangent for its inverse": ["tan(a/b)*2"],
                "a and b exchanged": ["atan2(b, a)*2"],
            },
        ),
        ("atan2(a, 1) + 2", "a", {"not solved for the angle": ["a/1 + 2"],
                                  "the tangent for its inverse": ["tan(a/1) + 2"]}),
        ("a + b", "a", {}),
        ("log(a) + b(a, 2)", "a", {}),
        ("cos(x, 2*x)", "x", {}),
        ("sin(3*x)", "x", {"sine and cosine exchanged": ["cos(3*x)"],
                           "the double angle": ["sin(2*(3*x))"],
                           "an angle in degrees": ["sin(180/pi*(3*x))"],
                           "an angle taken for degrees": ["sin(pi/180*(3*x))"],
                           "sine and cosine left out": ["1"]}),
    ],
)  # fmt: skip
def test_one_thing_is_wrong_throughout(formula, symbols, wrong):
    found: dict[str, list[str]] = {}
    for name, words, text in wholes(formula, tuple(symbols)):
        found.setdefault(name, []).append(text.replace(" ", "").replace(",", ", "))
        assert words[0].islower()
        if name.endswith(" exchanged") and "sine" not in name:
            assert words == name.replace(" exchanged", " have changed places")
    expected = {name: [t.replace(" ", "").replace(",", ", ") for t in texts]
                for name, texts in wrong.items()}  # fmt: skip
    assert found == expected


def test_the_order_is_from_what_many_do_to_what_symbols_may_do():
    names = [name for name, _, _ in wholes("cos(a)*b**2", ("a", "b"))]
    assert names[0] == "sine and cosine exchanged"
    assert names[-1] == "a and b exchanged"


@pytest.mark.parametrize(
    ("formula", "parts"),
    [
        ("2*(a + b)*(c - d)/e - -f",
         ["2 * a * c / e", "2 * a * -d / e", "2 * b * c / e", "2 * b * -d / e", "--f"]),
        ("-(a - b)", ["-a", "--b"]),
        ("a + b - (c + d)", ["a", "b", "-c", "-d"]),
        ("(a + b)**2", ["(a + b) ** 2"]),
        ("sin(a + b)*(a - 1)", ["sin(a + b) * a", "sin(a + b) * -1"]),
        ("a/(b + c)", ["a / (b + c)"]),
        (" +a", ["+a"]),
    ],
)  # fmt: skip
def test_a_formula_falls_into_terms_that_add_up_to_it(formula, parts):
    assert terms(formula) == parts
    values = dict(zip("abcdef", [1.5, -2.0, 0.7, 3.1, -1.3, 0.4], strict=True))
    total = sum(float(evaluate_formula(part, values)) for part in parts)
    assert total == pytest.approx(float(evaluate_formula(formula, values)))


POINTS = {"a": np.array([1.5, 2.0, 3.0]), "u": np.full(3, 9.0), "b": np.array([0.5, -1.0, 2.0])}
A, B = POINTS["a"], POINTS["b"]


def of(formula: str, at: Mapping[str, Any]) -> np.ndarray | None:
    return np.broadcast_to(evaluate_formula(formula, at), next(iter(at.values())).shape)


def test_slopes_and_areas_are_those_of_calculus():
    found = list(slopes(of, "a**3*b + cos(b)", ("u", "a", "x", "b"), POINTS))
    expected = [
        ("differentiated once more in a", 3 * A**2 * B),
        ("not differentiated in a", A**4 / 4 * B + A * np.cos(B)),
        ("differentiated once more in b", A**3 - np.sin(B)),
        ("not differentiated in b", A**3 * B**2 / 2 + np.sin(B)),
    ]
    assert [name for name, _, _ in found] == [name for name, _ in expected]
    for (_, words, values), (_, right) in zip(found, expected, strict=True):
        assert values == pytest.approx(right, rel=1e-8)
        assert words[:4] in ("this", "it w")
    assert found[0][1] == ("this is the derivative in a of what is asked for: one time too many")
    assert found[3][1] == "it was not differentiated in b, or integrated instead"


def test_what_has_no_values_has_no_slopes():
    assert list(slopes(lambda formula, at: None, "a*b", ("a", "b"), POINTS)) == []


def test_where_only_the_way_from_zero_has_no_values_the_derivative_is_left():
    def only_near(formula: str, at: Mapping[str, Any]) -> np.ndarray | None:
        return of(formula, at) if len(at["a"]) == 4 * len(A) else None

    found = [name for name, _, _ in slopes(only_near, "a*b", ("a", "b"), POINTS)]
    assert found == ["differentiated once more in a", "differentiated once more in b"]


def test_a_slope_without_a_value_warns_of_nothing():
    with np.errstate(all="raise"):
        found = list(slopes(lambda f, at: np.full(at["a"].shape, np.inf), "a", ("a",), POINTS))
    assert np.isnan(found[0][2]).all()
