"""A class for the orchard of the toy course: what is handed in, marks, and gradebooks of them."""

from __future__ import annotations

import json
import shutil
import sqlite3
from contextlib import closing
from pathlib import Path
from typing import Any

from autograder.course import Course, load_course
from autograder.gradebook import Gradebook, Record
from autograder.grading.graded_submission import Graded
from autograder.intake.submissions import Submission
from autograder.marking import Mark, Part
from tests.toy import make_toy

# One place for what an instructor's file never puts into a student's hands.
SECRETS = (
    "the secret of the orchard",
    "Apples are no cones",
    "the key's own words",
    "says the key to the orchard",
    "stands twice in the hedge",
    "the reference's own comment",
    "the orchard's key explains",
    "forgets the first apple",
    "You walked along two sides only",
)

RIGHT = {
    "Q1": 'ask("Q1").respond([False, True])',
    "Q2": "trees = 12",
    "Q3": 'import sympy as sp\nw, l = sp.symbols("w l")\nhedge = 2 * w + 2 * l',
    "Q4": "def heaviest(weights):\n    return max(weights)",
}
START = "from autograder import ask, check, progress, submit"


def make_course(root: Path) -> Course:
    """The orchard at ``root``, with a notebook to hand in."""
    toy = make_toy(root, "orchard")
    (root / "notebooks/3_orchard.ipynb").write_text(notebook([START]))
    return toy.load()


def notebook(cells: list[str]) -> str:
    """A notebook of code cells."""
    return json.dumps(
        {
            "nbformat": 4,
            "nbformat_minor": 5,
            "metadata": {},
            "cells": [
                {
                    "cell_type": "code",
                    "id": f"cell-{number}",
                    "metadata": {},
                    "execution_count": None,
                    "outputs": [],
                    "source": source,
                }
                for number, source in enumerate(cells)
            ],
        }
    )


def hand_in(folder: Path, student: str, **responses: str) -> Path:
    """Write a submission that is right except where ``responses`` say otherwise."""
    path = folder / student / "3_orchard.ipynb"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(notebook([START, *{**RIGHT, **responses}.values()]))
    return path.parent


def mark(question: str, credit: float, most: float = 2.0, **fields: Any) -> Mark:
    """A mark with a status that fits its credit."""
    status = "right" if credit == 1 else "partial" if credit else "wrong"
    fields = {"status": status, "feedback": "Say why.", **fields}
    return Mark(question=question, credit=credit, max_points=most, **fields)


def graded(student: str, *marks: Mark, **fields: Any) -> Graded:
    """A graded submission without any files."""
    values: dict[str, Any] = {"status": "graded", "fingerprint": "f" + student, **fields}
    return Graded(Submission(student, Path(f"/class/{student}.zip")), marks=marks, **values)


def all_marks(credits: tuple[float, float, float, float] = (1, 1, 1, 1)) -> tuple[Mark, ...]:
    """Marks for every question of the course."""
    return tuple(
        mark(id, credit, most, alternative="right" if credit == 1 else None)
        for id, credit, most in zip(("Q1", "Q2", "Q3", "Q4"), credits, (2, 2, 2, 4), strict=True)
    )


def class_of(*credits: tuple[float, float, float, float]) -> list[Record]:
    """A record for each student, who earned so much of each question."""
    return [
        Record(graded(f"student {number:02}", *all_marks(row)), 1, 1)
        for number, row in enumerate(credits)
    ]


def hostile_mark(question: str, text: str, most: float = 2.0) -> Mark:
    """A mark that says ``text`` wherever a student's text may get to."""
    return mark(
        question,
        0.5,
        most,
        feedback=text,
        understood=text,
        alternative=text,
        explanation=text,
        parts=(Part(text, False, text),),
    )


def fill(book: Gradebook, *entries: Graded, seed: int = 1) -> None:
    """Put submissions into a gradebook, as one finished run."""
    run = book.begin_run("version", seed, "a separate process")
    for entry in entries:
        book.store(entry, run)
    book.finish_run(run, 1.0)


def stored(gradebook: Path) -> int:
    """How many submissions a gradebook has that another process writes; 0 while there is none."""
    try:
        address = f"file:{gradebook}?mode=ro"
        with closing(sqlite3.connect(address, uri=True, timeout=30)) as db:
            return int(db.execute("SELECT count(*) FROM submission").fetchone()[0])
    except sqlite3.OperationalError:
        return 0


def copy_course(course: Course, root: Path) -> Course:
    """A copy that a test may change."""
    shutil.copytree(course.root, root)
    return load_course(root)
