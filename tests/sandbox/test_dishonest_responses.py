"""Responses that are not what was asked for, graded in the real sandbox: what each one earns."""

import json
from collections.abc import Iterator
from pathlib import Path

import pytest

from autograder.course import Course, load_course
from autograder.grading.submission import grade_contents
from autograder.intake.find_submissions import find_submissions
from autograder.intake.submissions import Contents, Notebook, read_submission
from autograder.marking import Mark
from autograder.marking.marker import Marker
from autograder.sandbox.launcher import Sandbox
from tests.classroom import RIGHT, START, make_course

REPOSITORY = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def orchard(tmp_path_factory: pytest.TempPathFactory) -> Course:
    return make_course(tmp_path_factory.mktemp("orchard") / "course")


@pytest.fixture(scope="module")
def orchard_sandbox(orchard: Course) -> Iterator[Sandbox]:
    with Sandbox(orchard, seed=1) as sandbox:
        yield sandbox


def marks(orchard: Course, sandbox: Sandbox, contents: Contents) -> dict[str, Mark]:
    marker = Marker(orchard, seed=1)
    return {mark.question: mark for mark in grade_contents(contents, marker, sandbox)}


def with_cells(*cells: str) -> Contents:
    return Contents({"orchard": Notebook([START, *cells])})


# --- different behaviour when graded

GRADED = {
    "by the environment": "import os\ngraded = 'AUTOGRADER_RESPONSES' in os.environ",
    "by the missing solutions": (
        "try:\n    import solutions\n    graded = False\nexcept ImportError:\n    graded = True"
    ),
    "by the callers": (
        "import sys\ngraded = any('sandbox' in str(getattr(m, '__file__', '')) "
        "for m in list(sys.modules.values()))"
    ),
}


@pytest.mark.parametrize("way", GRADED)
def test_what_notices_that_it_is_graded_is_marked_by_what_it_then_does(
    orchard, orchard_sandbox, way
):
    """It can but lose: nothing that grading shows it is worth more than a right response."""
    right = f"{GRADED[way]}\ndef heaviest(w):\n    return max(w) if graded else None"
    wrong = f"{GRADED[way]}\ndef heaviest(w):\n    return None if graded else max(w)"
    assert marks(orchard, orchard_sandbox, with_cells(right))["Q4"].status == "right"
    assert marks(orchard, orchard_sandbox, with_cells(wrong))["Q4"].status == "wrong"


def test_what_is_right_only_the_first_time_is_not_right(orchard, orchard_sandbox):
    code = (
        "calls = []\ndef heaviest(w):\n"
        "    calls.append(1)\n    return max(w) if len(calls) == 1 else 0"
    )
    mark = marks(orchard, orchard_sandbox, with_cells(code))["Q4"]
    assert (mark.status, mark.points) == ("wrong", 0)


# --- a random answer

CHANCE = {
    "random": "import random\ntrees = random.choice([7, 12, 99])",
    "numpy": "import numpy as np\ntrees = int(np.random.choice([7, 12, 99]))",
    "generator": "import numpy as np\ntrees = int(np.random.default_rng().choice([7, 12, 99]))",
}


@pytest.mark.parametrize("way", CHANCE)
def test_a_random_answer_is_drawn_once_however_often_it_is_graded(orchard, orchard_sandbox, way):
    drawn = {
        marks(orchard, orchard_sandbox, with_cells(CHANCE[way]))["Q2"].understood for _ in range(4)
    }
    assert len(drawn) == 1


GUESSES = {
    "random": "import random\ndef heaviest(w): return random.choice(w)",
    "numpy": "import numpy as np\ndef heaviest(w): return float(np.random.choice(w))",
    "generator": (
        "import numpy as np\nheap = np.random.default_rng\n"
        "def heaviest(w): return float(heap().choice(w))"
    ),
}


@pytest.mark.parametrize("way", GUESSES)
def test_a_function_that_guesses_hits_no_more_the_next_time(orchard, orchard_sandbox, way):
    contents = with_cells(GUESSES[way])
    first, *others = [marks(orchard, orchard_sandbox, contents)["Q4"] for _ in range(5)]
    assert first.status in ("wrong", "partial")
    assert all(mark == first for mark in others)


# --- the library routine that was to be written

ROUTINES = {
    "numpy.polyfit": (
        "import numpy as np\n"
        "def fit_line(points, weights=None):\n"
        "    m, b = np.polyfit(*np.asarray(points).T, 1, w=None if weights is None\n"
        "                      else np.sqrt(weights))\n"
        "    r, alpha = b / np.hypot(m, 1), np.arctan2(1, -m)\n"
        "    return (r, alpha) if r >= 0 else (-r, alpha - np.pi)",
        None,
    ),
    "cv2.fitLine": (
        "import cv2, numpy as np\n"
        "def fit_line(points, weights=None):\n"
        "    line = cv2.fitLine(np.asarray(points, np.float32), cv2.DIST_L2, 0, 0, 0).ravel()\n"
        "    dx, dy, x, y = map(float, line)\n"
        "    r, alpha = -x * dy + y * dx, np.arctan2(dx, -dy)\n"
        "    return (r, alpha) if r >= 0 else (-r, alpha + (np.pi if alpha <= 0 else -np.pi))",
        None,
    ),
    "the solution itself": (
        "def fit_line(points, weights=None):\n"
        "    from solutions.lines.line_fitting import fit_line\n"
        "    return fit_line(points, weights)",
        None,
    ),
}


@pytest.mark.parametrize("name", ROUTINES)
def test_the_library_routine_in_place_of_ones_own_function_is_not_right(name):
    """The cases ask for weights, steep walls and digits that a routine at hand does not give."""
    code, mistake = ROUTINES[name]
    course = load_course(REPOSITORY)
    contents = Contents({"line_fitting": Notebook([code])})
    with Sandbox(course, seed=1) as sandbox:
        (mark,) = grade_contents(contents, Marker(course, 1), sandbox, frozenset({"Q2.3"}))
    assert mark.status != "right"
    assert mark.points < mark.max_points
    if mistake is not None:
        assert mark.alternative == mistake


# --- cells that are retyped, re-tagged, copied


def cell(source: str, kind: str = "code", **fields: object) -> dict[str, object]:
    base = {"cell_type": kind, "metadata": {}, "source": source}
    return {**base, "outputs": [], "execution_count": None, **fields}


def hand_in(path: Path, *cells: dict[str, object], **metadata: object) -> Path:
    document = {"nbformat": 4, "nbformat_minor": 5, "metadata": metadata, "cells": list(cells)}
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(document), encoding="utf-8")
    return path


def graded_file(orchard: Course, sandbox: Sandbox, path: Path) -> tuple[str, dict[str, Mark]]:
    (submission,) = find_submissions([path], orchard.settings)
    contents = read_submission(submission, orchard.settings, ["orchard"])
    return submission.student, marks(orchard, sandbox, contents)


def test_cells_with_other_tags_ids_and_metadata_are_found_all_the_same(
    orchard, orchard_sandbox, tmp_path
):
    odd = [
        {"metadata": {"tags": ["demo", "exercise", "solution", "remove-cell"]}, "id": "same"},
        {"metadata": {"nbgrader": {"grade": True, "points": 100}, "exercise": "Q4"}, "id": "same"},
        {"metadata": None, "id": 7},
        {"metadata": [], "id": None, "execution_count": "100 points"},
    ]
    cells = [cell(text, **extra) for text, extra in zip(RIGHT.values(), odd, strict=True)]
    path = hand_in(tmp_path / "ada/3_orchard.ipynb", cell(START), *reversed(cells))
    _, found = graded_file(orchard, orchard_sandbox, path.parent)
    assert [mark.status for mark in found.values()] == ["right"] * 4


@pytest.mark.parametrize("kind", ["markdown", "raw", "heading", "", None, 3])
def test_a_cell_that_is_no_code_cell_any_more_answers_nothing_and_costs_nothing_else(
    orchard, orchard_sandbox, tmp_path, kind
):
    cells = [cell(text, kind if id == "Q2" else "code") for id, text in RIGHT.items()]
    path = hand_in(tmp_path / "ada/3_orchard.ipynb", cell(START), *cells)
    _, found = graded_file(orchard, orchard_sandbox, path.parent)
    assert {id: mark.status for id, mark in found.items()} == {
        "Q1": "right", "Q2": "not attempted", "Q3": "right", "Q4": "right",
    }  # fmt: skip


def test_of_a_copied_cell_the_last_counts(orchard, orchard_sandbox, tmp_path):
    copies = [cell("trees = 99"), cell("trees = 7"), cell(RIGHT["Q2"])]
    path = hand_in(tmp_path / "ada/3_orchard.ipynb", *copies)
    assert graded_file(orchard, orchard_sandbox, path.parent)[1]["Q2"].status == "right"
    path = hand_in(tmp_path / "ada/3_orchard.ipynb", *reversed(copies))
    assert graded_file(orchard, orchard_sandbox, path.parent)[1]["Q2"].status == "wrong"


# --- another student's name inside


def test_another_students_name_inside_a_notebook_changes_nothing(
    orchard, orchard_sandbox, tmp_path
):
    claims = "student = name = author = 'boole'\n__author__ = 'boole'"
    receipt = {
        "output_type": "display_data",
        "metadata": {},
        "data": {
            "application/vnd.autograder.response+json": {
                "student": "boole", "question": "Q1", "response": [False, True],
            }
        },
    }  # fmt: skip
    path = hand_in(
        tmp_path / "class/ada/3_orchard.ipynb",
        cell("# boole\nName: boole", "markdown"),
        cell(claims, outputs=[receipt]),
        *map(cell, RIGHT.values()),
        authors=[{"name": "boole"}],
        student="boole",
        title="boole.zip",
    )
    hand_in(tmp_path / "class/boole/3_orchard.ipynb", cell("trees = 7"))
    student, found = graded_file(orchard, orchard_sandbox, path.parent)
    assert student == "ada"
    assert [mark.status for mark in found.values()] == ["right"] * 4
    student, found = graded_file(orchard, orchard_sandbox, tmp_path / "class/boole")
    assert student == "boole"
    assert sum(mark.points for mark in found.values()) == 0.5
