"""Names in a course of another field: nobody wrote a relation for it."""

from __future__ import annotations

from pathlib import Path

import pytest
import sympy as sp

from autograder.course import load_course
from autograder.marking.marker import Marker
from autograder.sandbox.inside.evaluate import evaluate

ROOT = Path(__file__).parents[1] / "courses" / "kalman"
CORRECT = """
def correct(mean, variance, reading, noise):
    gain = variance / (variance + noise)
    return mean + gain * (reading - mean), (1 - gain) * variance
"""


@pytest.fixture(scope="module")
def marker():
    return Marker(load_course(ROOT), 5)


@pytest.mark.parametrize(
    ("change", "names"),
    [
        (("", ""), {"right"}),
        (
            ("mean + gain * (reading - mean), (1 - gain) * variance",
             "(1 - gain) * variance, mean + gain * (reading - mean)"),
            {"other order"},
        ),
        (("(reading - mean)", "(mean - reading)"), {"sign turned"}),
        (("(1 - gain) * variance", "gain * variance"), {"a complement left out"}),
        (("(1 - gain) * variance", "(1 - gain) ** 2 * variance"), {"a factor once more"}),
        (("(1 - gain) * variance", "((1 - gain) * variance) ** 0.5"), {"its root (second result)"}),
        (("* variance\n", "* variance, gain\n"), {"more results"}),
        (
            ("mean + gain * (reading - mean),", "round(mean + gain * (reading - mean), 1),"),
            {"rounded to 1 decimals (first result)"},
        ),
        ((", (1 - gain) * variance", ""), {"only the first"}),
        (("(reading - mean)", "reading"), {"term left out"}),
        (("variance + noise", "variance + noise ** 2"), {"argument squared (noise)"}),
        (("/ (variance + noise)", "/ noise if noise else 1"), {None}),
    ],
)  # fmt: skip
def test_functions(marker, change, names):
    written: dict[str, object] = {}
    exec(CORRECT.replace(*change), written)
    response = evaluate(written["correct"], marker.drawn("Q1.5").probe)
    assert marker.mark("Q1.5", response).alternative in names


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("1/P + 1/R", "reciprocal"),
        ("P*R", "factor left out"),
        ("sqrt(P*R/(P + R))", "its root"),
        ("P*R/(P - R)", "sign turned"),
        ("2*P*R/(P + R)", "twice"),
        ("P**2*R/(P + R)", "multiplied by P"),
    ],
)
def test_expressions(marker, text, name):
    symbols = {symbol: sp.Symbol(symbol, real=True) for symbol in "PR"}
    response = evaluate(sp.sympify(text, locals=symbols), marker.drawn("Q1.4").probe)
    assert marker.mark("Q1.4", response).alternative == name


@pytest.mark.parametrize(
    ("value", "name"),
    [(80, "in percent"), (1.25, "reciprocal"), (-0.8, "sign turned"), (0.9, None)],
)
def test_numbers(marker, value, name):
    response = evaluate(value, marker.drawn("Q1.3").probe)
    assert marker.mark("Q1.3", response).alternative == name
