"""Functions in many styles earn everything, and a slip in any of them costs something.

They stand in `styles_*.py`, one module a chapter. One seed is tried, and five with
AUTOGRADER_LONG=1.
"""

import math
import os

import numpy as np
import pytest
import styles_line_fitting
import styles_place_recognition
import styles_ransac
import sympy as sp
from given import what_a_chapter_gives
from marked import credit, defined, loses

CHAPTERS = (styles_place_recognition, styles_line_fitting, styles_ransac)
STYLES = {id: cells for chapter in CHAPTERS for id, cells in chapter.STYLES.items()}
SLIPS = {id: slips for chapter in CHAPTERS for id, slips in chapter.SLIPS.items()}
SEEDS = range(1, 6) if os.environ.get("AUTOGRADER_LONG") == "1" else (1,)

_MODULES = {"math": math, "np": np, "sp": sp}


def _names_of_chapter_2():
    """What stands above the questions: the class, and the student's own fit."""
    names = {**_MODULES, **what_a_chapter_gives("2_line_fitting", "Line")}
    return {**names, "fit_line": defined(STYLES["Q2.3"][0], names)}


def _names_of_chapter_3():
    given = ("Line", "fit_line", "distances", "Plane", "fit_plane", "plane_distances")
    names = {**_MODULES, **what_a_chapter_gives("3_ransac", *given)}
    names["required_iterations"] = defined(STYLES["Q3.3"][0], names)
    return {**names, "ransac_line": defined(STYLES["Q3.4"][0], names)}


NAMES = {"Q1": _MODULES, "Q2": _names_of_chapter_2(), "Q3": _names_of_chapter_3()}


def slipped(id, place, exchanged):
    """A right cell with something exchanged: what stood there, what stands there now, ..."""
    cell = STYLES[id][place]
    for old, new in zip(exchanged[::2], exchanged[1::2], strict=True):
        assert old in cell, f"{old!r} does not stand in {cell}"
        cell = cell.replace(old, new)
    return cell


@pytest.mark.parametrize("id", STYLES)
def test_a_style_never_loses(real_course, id):
    names = NAMES[id[:2]]
    lost = [
        (cell, seed)
        for seed in SEEDS
        for cell in STYLES[id]
        if credit(real_course, id, cell, seed, names) < 1
    ]
    assert lost == []


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("id", SLIPS)
def test_a_slip_never_earns_everything(real_course, id):
    names = NAMES[id[:2]]
    full = [
        (broken, exchanged, seed)
        for seed in SEEDS
        for broken, place, *exchanged in SLIPS[id]
        if not loses(real_course, id, slipped(id, place, exchanged), seed, names)
    ]
    assert full == []


def test_every_function_question_has_six_styles_and_eight_slips(real_course):
    asked = [id for id, q in real_course.questions.items() if q.kind == "function"]
    assert sorted(asked) == sorted(STYLES) == sorted(SLIPS)
    assert all(len(STYLES[id]) >= 6 and len(SLIPS[id]) >= 8 for id in asked)
