"""A kind of question that the engine has never heard of goes the whole way of the others.

The course of this test brings the kind along as ``notebooks/kinds/interval``. Everything is run in
processes of its own, as an instructor and a student would.
"""

import csv
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_notebook

from tests.toy import Toy, make_toy

KIND = '''
"""Two numbers: the ends of an interval."""

from typing import Any

import numpy as np

from autograder.questions.answer import Alternative, Answer
from autograder.questions.code_kinds import CodeKind
from autograder.questions.question import PointedQuestion
from autograder.questions.mark import Mark, Part, status_for
from msgspec import field


class Interval(PointedQuestion, frozen=True, kw_only=True, tag="interval"):
    kind = "interval"
    variable: str

    @property
    def name(self):
        return self.variable


class Ends(Alternative, frozen=True, kw_only=True):
    ends: tuple[float, float]

    def __post_init__(self):
        super().__post_init__()
        if self.ends[0] > self.ends[1]:
            raise ValueError("the lower end comes first")


class IntervalAnswer(Answer, frozen=True, kw_only=True):
    alternatives: tuple[Ends, ...] = field(default=(), name="alternative")


class IntervalKind(CodeKind[Interval, IntervalAnswer]):
    name = "interval"
    question_type = Interval
    answer_type = IntervalAnswer
    inside = "notebooks.kinds.interval.inside.evaluate"
    parts_heading = "Ends"

    def mark_given(self, question, answer, drawn, response, understood):
        given = response.get("values")
        if not (isinstance(given, np.ndarray) and given.shape == (2,)):
            return None
        for entry in answer.alternatives:
            agree = np.isclose(given, entry.ends)
            if agree.all():
                feedback = entry.feedback or "Right."
                return Mark(
                    question.id, status_for(entry.credit), entry.credit, question.points,
                    feedback, entry.name, understood=understood, explanation=answer.explanation,
                )
        right = np.isclose(given, answer.alternatives[0].ends)
        parts = tuple(
            Part(f"The {which} end", bool(agrees), "")
            for which, agrees in zip(("lower", "upper"), right)
        )
        credit = right.sum() / 2
        return Mark(
            question.id, status_for(credit), credit, question.points, "An end is off.", parts=parts
        )

    def widget(self, desk, question, *checked):
        from autograder.student.widgets.value import ValueWidget

        return ValueWidget(desk, question, *checked)

    def response_like(self, question, alternative, drawn):
        return {"state": "given", "values": np.array(alternative.ends)}

    def read_as(self, question, mark):
        return [f"from {mark.understood.strip('()').replace(', ', ' to ')}"]

    def secrets(self, question, answer):
        yield from super().secrets(question, answer)
        yield "ends of the interval are " + str(answer.alternatives[0].ends)

    def take_snapshot(self, question, answer, drawn, again):
        return {"checked": answer.snapshot, "ends": list(answer.alternatives[0].ends)}, []

    def mark_snapshot(self, question, snapshot, response):
        right = np.allclose(response.get("values"), snapshot["ends"])
        status, credit = ("right", 1.0) if right else ("wrong", 0.0)
        return Mark(question.id, status, credit, question.points, "Compared with an example.")


KIND = IntervalKind()
'''
INSIDE = """
import numpy as np

from autograder.sandbox.inside.plain_data import Unusable, plain_number


def evaluate(response, probe):
    if not (isinstance(response, tuple) and len(response) == 2):
        raise Unusable("several")
    return {"values": np.array([float(plain_number(end)) for end in response])}
"""
QUESTION = """
[[question]]
id = "Q2.2"
kind = "interval"
title = "Degrees"
points = 4
variable = "degrees"
prompt = "Between which degrees Celsius is water liquid at sea level?"
hints = ["Ice and steam."]
"""
ANSWER = """
["Q2.2"]
code = "(0, 100)"
explanation = "It freezes at zero and boils at a hundred."
[["Q2.2".alternative]]
name = "right"
ends = [0, 100]
credit = 1.0
[["Q2.2".alternative]]
name = "Fahrenheit"
ends = [32, 212]
credit = 0.5
feedback = "These are degrees Fahrenheit; convert them."
[["Q2.2".alternative]]
name = "kelvin"
ends = [273.15, 373.15]
credit = 0.5
feedback = "These are kelvin; subtract 273.15."
"""
FILES = {
    "notebooks/__init__.py": "",
    "notebooks/kinds/__init__.py": "",
    "notebooks/kinds/interval/__init__.py": "",
    "notebooks/kinds/interval/kind.py": KIND,
    "notebooks/kinds/interval/inside/__init__.py": "",
    "notebooks/kinds/interval/inside/evaluate.py": INSIDE,
}


def run(*command: str, cwd: Path, **environment: str) -> str:
    done = subprocess.run(
        [sys.executable, *command],
        cwd=cwd,
        env={**os.environ, "AUTOGRADER_WIDGETS": "0", **environment},
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Path:
    toy = make_toy(tmp_path_factory.mktemp("outside") / "course", "cellar")
    for name, text in FILES.items():
        path = toy.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    toy.add("cellar", QUESTION, ANSWER).set('kinds = ["notebooks.kinds.interval"]')
    toy.append("notebooks/source/2_cellar.py", '\n# %% exercise="Q2.2"\n')
    run("-m", "autograder", "build", cwd=toy.root)
    return toy.root


def hand_in(folder: Path, student: str, code: str) -> None:
    folder.mkdir(exist_ok=True)
    notebook = new_notebook(cells=[new_code_cell(code)])
    (folder / student).mkdir()
    nbformat.write(notebook, folder / student / "2_cellar.ipynb")


@pytest.fixture(scope="module")
def graded(course: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The reports on a class of four."""
    handed_in = tmp_path_factory.mktemp("class") / "submissions"
    hand_in(handed_in, "right", "degrees = (0, 100.0)")
    hand_in(handed_in, "fahrenheit", "degrees = (32, 212)")
    hand_in(handed_in, "half", "degrees = (0, 90)")
    hand_in(handed_in, "text", "degrees = 'warm'")
    out = handed_in.parent / "grades"
    run("-m", "autograder", "grade", str(handed_in), "--out", str(out), "--jobs", "1", cwd=course)
    return out


def test_the_course_proves_the_kind(course: Path):
    run("-m", "autograder", "check", cwd=course)
    built = nbformat.read(course / "notebooks/2_cellar.ipynb", as_version=4)
    assert any(cell.source == "degrees = ..." for cell in built.cells)


def test_a_broken_key_of_the_kind_is_said_with_its_place(course: Path, tmp_path: Path):
    broken = tmp_path / "broken"
    shutil.copytree(course, broken)
    Toy(broken).replace("solutions/answers/cellar.toml", "[32, 212]", "[212, 32]")
    done = subprocess.run(
        [sys.executable, "-m", "autograder", "check"], cwd=broken, capture_output=True, text=True
    )
    assert done.returncode == 1
    said = done.stdout + done.stderr
    assert "Fahrenheit" in said
    assert "Q2.2" in said
    assert "the lower end comes first" in said


def test_a_student_asks_and_checks(course: Path, tmp_path: Path):
    said = run(
        "-c",
        "from autograder import ask, check\n"
        "print(ask('Q2.2'))\n"
        "print(check('Q2.2', (32, 212)))\n"
        "print(check('Q2.2', (0, 100)))\n",
        cwd=course / "notebooks",
        AUTOGRADER_RESPONSES=str(tmp_path),
    )
    asked, wrong, right = said.partition("Q2.2 partial")[0], *said.split("Q2.2 partial")[1:], said
    assert 'check("Q2.2", degrees)' in asked
    assert "degrees Fahrenheit; convert" in wrong
    assert "Q2.2 right" in right


def marks(graded: Path) -> dict[str, dict[str, Any]]:
    with (graded / "grades.csv").open(newline="", encoding="utf-8-sig") as file:
        return {row["student"]: row for row in csv.DictReader(file)}


def test_a_class_is_graded(graded: Path):
    points = {student: float(row["Q2.2"]) for student, row in marks(graded).items()}
    assert points == {"right": 4.0, "fahrenheit": 2.0, "half": 2.0, "text": 0.0}


def test_the_page_of_feedback_shows_how_it_was_read_and_which_end_is_off(graded: Path):
    page = (graded / "feedback/half.html").read_text()
    assert "from 0 to 90" in page
    assert "Ends" in page
    assert "The upper end" in page


def test_the_page_of_the_class_names_the_mistakes(graded: Path):
    page = next(graded.glob("*.html")).read_text()
    assert "Fahrenheit" in page
    assert "wrong on: The upper end" in page


def test_a_bundle_for_practice_has_the_kind_and_the_key(course: Path, tmp_path: Path):
    bundle = tmp_path / "bundle"
    run("-m", "autograder", "release", str(bundle), "--practice", "cellar", cwd=course)
    said = run(
        "-c",
        "from autograder import check\nprint(check('Q2.2', (32, 212)))\n",
        cwd=bundle / "notebooks",
    )
    assert "degrees Fahrenheit; convert" in said


def test_a_bundle_without_the_key_checks_on_its_snapshot(course: Path, tmp_path: Path):
    bundle = tmp_path / "bundle"
    run("-m", "autograder", "release", str(bundle), cwd=course)
    assert (bundle / "notebooks/kinds/interval/kind.py").exists()
    assert json.loads((bundle / "notebooks/snapshots/cellar.json").read_text())["Q2.2"]["checked"]
    said = run(
        "-c",
        "from autograder import check\n"
        "print(check('Q2.2', (0, 100)))\nprint(check('Q2.2', (0, 90)))\n",
        cwd=bundle / "notebooks",
    )
    assert "Q2.2 right" in said
    assert "Q2.2 wrong" in said
