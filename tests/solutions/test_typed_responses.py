"""No right number or expression loses, no wrong one earns everything, however it is typed.

The responses stand in `responses_typed.py`; they are tried under three seeds.
"""

import itertools
import math
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
import sympy as sp
from responses_typed import RIGHT, WRONG

from autograder.marking.draw import draw
from autograder.questions.registry import kind_of
from autograder.sandbox.inside.evaluate import evaluate

SEEDS = (1, 2, 3)
_SYMBOLS = "r alpha N x_c y_c sum_x sum_y S_xx S_yy S_xy"
NAMES = {
    "Decimal": Decimal,
    "Fraction": Fraction,
    "itertools": itertools,
    "math": math,
    "np": np,
    "sp": sp,
    "w": sp.Symbol("w", positive=True),
    **{name: sp.Symbol(name, real=True) for name in _SYMBOLS.split()},
}


def credits(course, id, typed):
    """What a response earns under each seed."""
    question, answer = course.questions[id], course.key[id]
    response = eval(typed, dict(NAMES))
    for seed in SEEDS:
        drawn = draw(question, answer, seed, course.root)
        reply = evaluate(response, drawn.probe)
        yield kind_of(question).mark(question, answer, drawn, reply).credit


@pytest.mark.filterwarnings("ignore::PendingDeprecationWarning")  # NumPy's of its matrix
@pytest.mark.parametrize("id", RIGHT)
def test_a_right_response_never_loses(real_course, id):
    lost = [typed for typed in RIGHT[id] if min(credits(real_course, id, typed)) < 1]
    assert lost == []


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("id", WRONG)
def test_a_wrong_response_never_earns_everything(real_course, id):
    full = [typed for typed in WRONG[id] if max(credits(real_course, id, typed)) == 1]
    assert full == []


def test_every_question_that_asks_for_a_value_has_some(real_course):
    asked = [id for id, q in real_course.questions.items() if q.kind in ("number", "expression")]
    assert sorted(asked) == sorted(RIGHT) == sorted(WRONG)
    assert all(len(RIGHT[id]) >= 10 and len(WRONG[id]) >= 10 for id in asked)
