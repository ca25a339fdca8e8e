"""Right work in other clothes earns everything, whatever the hidden inputs."""

import inspect
import tomllib
from dataclasses import replace
from functools import cache
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
import sympy as sp

from autograder.course import Course
from autograder.kinds.answer import Answer
from autograder.kinds.drawn import Drawn
from autograder.kinds.registry import kind_of
from autograder.marking.draw import draw
from autograder.sandbox.inside.evaluate import evaluate

SEEDS = range(25)
EXPRESSIONS = tomllib.loads(Path("solutions/variants/expressions.toml").read_text("utf-8"))
FUNCTIONS = {
    "Q1.3": "assign_words",
    "Q1.4": "descend_tree",
    "Q1.5": "build_inverted_file",
    "Q1.6": "count_votes",
    "Q1.7": "idf_weights",
    "Q1.8": "l1_scores",
    "Q2.3": "fit_line",
    "Q2.4": "line_covariance",
    "Q3.3": "required_iterations",
    "Q3.4": "ransac_line",
    "Q3.5": "ransac_plane",
    "Q3.6": "find_walls",
}


def functions(module: ModuleType) -> list[Any]:
    """The variants in a module; what it imports and what begins with an underscore is none."""
    return [
        value
        for name, value in vars(module).items()
        if inspect.isfunction(value)
        and value.__module__ == module.__name__
        and not name.startswith("_")
    ]


def typed(text: str) -> Any:
    """What a student's cell makes of an expression, with the symbols of the chapter."""
    names = "r alpha N x_c y_c sum_x sum_y S_xx S_yy S_xy"
    symbols = dict(zip(names.split(), sp.symbols(names, real=True), strict=True))
    return eval(text, {"sp": sp, "w": sp.Symbol("w", positive=True), **symbols})


@cache
def drawn_for(course: Course, id: str, seed: int) -> tuple[Answer, Drawn]:
    """A question made ready, without its mistakes: to run them takes long and changes nothing."""
    question, answer = course.questions[id], course.key[id]
    if id in FUNCTIONS:
        answer = replace(answer, alternatives=())
    return answer, draw(question, answer, seed, course.root)


def lost(course: Course, id: str, response: Any) -> list[str]:
    """The feedback of every seed under which the response earns less than everything."""
    question, said = course.questions[id], []
    for seed in SEEDS:
        answer, drawn = drawn_for(course, id, seed)
        with np.errstate(all="ignore"):
            reply = evaluate(response, drawn.probe)
        mark = kind_of(question).mark(question, answer, drawn, reply, "")
        if (mark.status, mark.credit) != ("right", 1):
            said.append(f"seed {seed}: {mark.feedback}")
    return said


def test_every_typed_question_has_variants(real_course):
    kinds = {question.kind: set() for question in real_course.questions.values()}
    for id, question in real_course.questions.items():
        kinds[question.kind].add(id)
    assert set(EXPRESSIONS) == kinds["expression"]
    assert set(FUNCTIONS) == kinds["function"]
    for id, forms in EXPRESSIONS.items():
        assert len(set(forms)) >= 6, id
    for id, name in FUNCTIONS.items():
        assert len(functions(import_module(f"solutions.variants.{name}"))) >= 4, id


@pytest.mark.parametrize("id", FUNCTIONS)
def test_a_function_in_another_style_earns_everything(real_course, id):
    module = import_module(f"solutions.variants.{FUNCTIONS[id]}")
    found = {function.__name__: lost(real_course, id, function) for function in functions(module)}
    assert not any(found.values()), found


@pytest.mark.parametrize("id", EXPRESSIONS)
def test_an_equal_expression_earns_everything(real_course, id):
    found = {text: lost(real_course, id, typed(text)) for text in EXPRESSIONS[id]}
    assert not any(found.values()), found
