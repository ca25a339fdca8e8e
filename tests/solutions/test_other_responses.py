"""No right response loses, no wrong one gets everything, under three seeds.

The responses stand in `responses.py`, `responses_to_stubs.py` and `responses_from_prompts.py`.
"""

import math

import numpy as np
import pytest
import responses
import responses_from_prompts
import responses_to_stubs
import sympy as sp
from given import what_a_chapter_gives
from marked import credit, defined, drawn_for, loses
from responses import CHANCE

from autograder.kinds.function.marking import agrees
from autograder.sandbox.inside.evaluate import evaluate
from solutions.lines.line_fitting import Line, distances, fit_line
from solutions.ransac.line import ransac_line
from solutions.ransac.probabilities import required_iterations

pytestmark = pytest.mark.long

_SETS = (responses, responses_to_stubs, responses_from_prompts)
RIGHT = {
    id: [c for one in _SETS for c in one.RIGHT.get(id, ())] for one in _SETS for id in one.RIGHT
}
WRONG = {
    id: [c for one in _SETS for c in one.WRONG.get(id, ())] for one in _SETS for id in one.WRONG
}

SEEDS = (1, 2, 3)
_SYMBOLS = "r alpha N x_c y_c sum_x sum_y S_xx S_yy S_xy"
NAMES = {
    "math": math,
    "np": np,
    "sp": sp,
    "Line": Line,
    "distances": distances,
    "fit_line": fit_line,
    "ransac_line": ransac_line,
    "required_iterations": required_iterations,
    **what_a_chapter_gives("3_ransac", "Plane", "fit_plane", "plane_distances"),
    "w": sp.Symbol("w", positive=True),
    **{name: sp.Symbol(name, real=True) for name in _SYMBOLS.split()},
}


def kinds_right(course, id, cell, seed):
    """The kinds of input on which a function is right."""
    _, drawn = drawn_for(course, id, seed)
    expected = drawn.expected
    outcomes = evaluate(defined(cell, NAMES), drawn.probe)["outcomes"]
    right = {case["name"]: True for case in expected.cases}
    for case, wanted, outcome in zip(expected.cases, expected.outcomes, outcomes, strict=True):
        right[case["name"]] &= agrees(expected.compare, case, wanted, outcome)
    return [name for name in right if right[name]]


@pytest.mark.parametrize("id", CHANCE)
def test_luck_does_not_decide_on_work_that_draws_too_little(real_course, id):
    """What a function earns follows from the kinds of input on which it is right."""
    found = [kinds_right(real_course, id, CHANCE[id], seed) for seed in range(1, 26)]
    assert all(kinds == found[0] for kinds in found)
    assert len(found[0]) < len(drawn_for(real_course, id, 1)[1].expected.cases) / 2


@pytest.mark.parametrize("id", RIGHT)
def test_a_right_response_never_loses(real_course, id):
    lost = [
        (c, seed)
        for c in RIGHT[id]
        for seed in SEEDS
        if credit(real_course, id, c, seed, NAMES) < 1
    ]
    assert lost == []


@pytest.mark.parametrize("id", WRONG)
def test_a_wrong_response_never_earns_everything(real_course, id):
    full = [
        (c, seed) for c in WRONG[id] for seed in SEEDS if not loses(real_course, id, c, seed, NAMES)
    ]
    assert full == []
