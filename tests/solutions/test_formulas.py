"""No right formula, number or function loses, and no wrong one earns everything."""

from __future__ import annotations

import ast
import math
from decimal import Decimal
from fractions import Fraction
from typing import Any

import formulas
import numpy as np
import pytest
import sympy as sp

from autograder.course import Course
from autograder.exchange.messages import Message
from autograder.kinds.function.marking import agrees
from autograder.marking.draw import draw
from autograder.questions.answer import Answer
from autograder.questions.drawn import Drawn
from autograder.questions.question import Question
from autograder.questions.registry import kind_of
from autograder.sandbox.inside.evaluate import evaluate

SEEDS = (11, 12, 13)
REAL = "r alpha N x_c y_c sum_x sum_y S_xx S_yy S_xy t q"
NAMES: dict[str, Any] = {
    **{name: getattr(sp, name) for name in sp.__all__ if not name.startswith("_")},
    **{name: sp.Symbol(name, real=True) for name in REAL.split()},
    "math": math, "np": np, "sp": sp, "Decimal": Decimal, "Fraction": Fraction,
    "round": round, "sum": sum,
}  # fmt: skip


def written(text: str) -> Any:
    """What a text gives: a value, or the function that it defines last."""
    names = dict(NAMES)
    if "def " not in text:
        return eval(text, names)
    exec(text, names)
    return names[ast.parse(text).body[-1].name]  # type: ignore[attr-defined]


def all_right(course: Course, id: str, texts: list[str]) -> dict[tuple[str, int], bool]:
    """Whether each response earns everything, under each seed."""
    question, answer = course.question(id), course.key[id]
    found = {}
    for seed in SEEDS:
        drawn = draw(question, answer, seed, course.root)
        for text in texts:
            with np.errstate(all="ignore"):
                reply = evaluate(written(text), drawn.probe)
            found[text, seed] = earns_everything(question, answer, drawn, reply)
    return found


def earns_everything(question: Question, answer: Answer, drawn: Drawn, reply: Message) -> bool:
    if question.kind != "function":
        return kind_of(question).mark(question, answer, drawn, reply).credit == 1
    # As its mark does, but without a name for what is wrong, which takes long.
    expected, outcomes = drawn.expected, reply["outcomes"]
    return all(
        agrees(expected.compare, case, right, outcome)
        for case, right, outcome in zip(expected.cases, expected.outcomes, outcomes, strict=True)
    )


@pytest.mark.parametrize("id", formulas.RIGHT)
def test_what_is_right_never_loses(real_course, id):
    assert len(formulas.RIGHT[id]) >= 15
    found = all_right(real_course, id, formulas.RIGHT[id])
    assert [key for key, everything in found.items() if not everything] == []


@pytest.mark.parametrize("id", formulas.WRONG)
def test_what_is_wrong_never_earns_everything(real_course, id):
    assert len(formulas.WRONG[id]) >= 15
    found = all_right(real_course, id, formulas.WRONG[id])
    assert [key for key, everything in found.items() if everything] == []
