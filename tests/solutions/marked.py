"""Cells of code as students write them, marked as their work is."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from typing import Any

import numpy as np
from msgspec import structs

from autograder.course import Course
from autograder.kinds.function.marking import agrees
from autograder.marking.draw import draw
from autograder.questions.registry import kind_of
from autograder.sandbox.inside.evaluate import evaluate

Names = Mapping[str, Any]
_DRAWN: dict[tuple[str, int], Any] = {}


def drawn_for(course: Course, id: str, seed: int) -> Any:
    """A question made ready, without its known mistakes: they make no wrong response right."""
    if (id, seed) not in _DRAWN:
        question, answer = course.questions[id], course.key[id]
        if kind_of(question).solutions(answer):
            answer = structs.replace(answer, alternatives=())
        _DRAWN[id, seed] = answer, draw(question, answer, seed, course.root)
    return _DRAWN[id, seed]


def defined(cell: str, names: Names) -> Any:
    """What a cell of code defines last, where these names are known."""
    statement = ast.parse(cell).body[-1]
    name = statement.name if isinstance(statement, ast.FunctionDef) else statement.targets[0].id  # type: ignore[attr-defined]
    known = dict(names)
    exec(cell, known)
    return known[name]


def credit(course: Course, id: str, cell: str, seed: int, names: Names) -> float:
    """What a response earns."""
    answer, drawn = drawn_for(course, id, seed)
    question = course.questions[id]
    with np.errstate(all="ignore"):
        reply = evaluate(defined(cell, names), drawn.probe)
    return kind_of(question).mark(question, answer, drawn, reply).credit


def loses(course: Course, id: str, cell: str, seed: int, names: Names) -> bool:
    """Whether a response earns less than everything; a function, as soon as one case tells."""
    if course.questions[id].kind != "function":
        return credit(course, id, cell, seed, names) < 1
    _, drawn = drawn_for(course, id, seed)
    function, expected = defined(cell, names), drawn.expected
    # From the end: there stand the inputs that take no time.
    for case, right in reversed([*zip(expected.cases, expected.outcomes, strict=True)]):
        with np.errstate(all="ignore"):
            reply = evaluate(function, {**drawn.probe, "cases": [case]})
        if not agrees(expected.compare, case, right, reply["outcomes"][0]):
            return True
    return False
