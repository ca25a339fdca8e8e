"""A small course and its class, for the tests of what instructors use."""

from __future__ import annotations

import json
import shutil
import sqlite3
from contextlib import closing
from pathlib import Path
from typing import Any

from autograder.course import Course, load_course
from autograder.gradebook import Gradebook
from autograder.grading.graded import Graded
from autograder.intake.submissions import Submission
from autograder.marking import Mark, Part

QUESTIONS = """
title = "The orchard"

[[question]]
id = "Q1"
kind = "true_false"
title = "Trees"
prompt = "Which of these $n = 2$ claims hold?"
statements = ["An apple tree has cones.", "A cherry tree has blossoms."]
hints = ["Look up in spring."]

[[question]]
id = "Q2"
kind = "number"
points = 2
variable = "trees"
integer = true
title = "The rows"
prompt = "Three rows of four trees stand there. How many trees are that?"
hints = ["Rows times trees in a row."]

[[question]]
id = "Q3"
kind = "expression"
points = 2
variable = "hedge"
title = "The hedge"
prompt = "How long is the hedge round an orchard of width $w$ and length $l$?"
hints = ["It has four sides."]
[question.symbols]
w = "width"
l = "length"

[[question]]
id = "Q4"
kind = "function"
points = 4
function = "heaviest"
title = "The heaviest apple"
prompt = "Return the weight of the heaviest apple."
hints = ["What if there is one apple only?"]
"""

ANSWERS = """
["Q1"]
explanation = "Cones grow on conifers, the secret of the orchard."
[["Q1".statement]]
truth = false
explanation = "Apples are no cones."
misconception = "You may be thinking of a fir: look for needles."
[["Q1".statement]]
truth = true
explanation = "Every cherry was a blossom."
misconception = "Cherries start as blossoms: come back in spring."

["Q2"]
code = "3 * 4  # the key's own words"
explanation = "Rows multiply, says the key to the orchard."
[["Q2".alternative]]
name = "right"
value = 12
credit = 1.0
[["Q2".alternative]]
name = "rows and trees added"
value = 7
credit = 0.25
feedback = "That is three plus four: multiply them."

["Q3"]
code = "2 * (w + l)"
explanation = "Each side of the orchard stands twice in the hedge."
sample = {w = [1, 5], l = [1, 5]}
[["Q3".alternative]]
name = "right"
expression = "2*w + 2*l"
credit = 1.0
[["Q3".alternative]]
name = "each side once"
expression = "w + l"
credit = 0.5
feedback = "You walked along two sides only."

["Q4"]
reference = "orchard_reference:heaviest"
cases = "orchard_reference:heaviest_cases"
explanation = "A maximum that the orchard's key explains."
[["Q4".alternative]]
name = "forgets the first apple"
function = "orchard_reference:forgets_the_first"
credit = 0.5
feedback = "The first apple is missing from your search."
[["Q4".alternative]]
name = "the lightest apple"
function = "orchard_reference:lightest"
credit = 0.25
feedback = "That is the lightest one."
"""

SOLUTIONS = '''
def heaviest(weights):
    """Return the weight of the heaviest apple."""
    most = weights[0]  # the reference's own comment
    for weight in weights:
        most = max(most, weight)
    return most


def forgets_the_first(weights):
    return max(weights[1:], default=0.0)


def lightest(weights):
    return min(weights)


def heaviest_cases(rng):
    hidden = [float(w) for w in rng.uniform(50, 250, 6)]
    return [
        {"name": "three apples", "args": [[120.0, 180.0, 150.0]], "public": True},
        {"name": "the first is the heaviest", "args": [[251.5, *hidden]]},
        {"name": "a basket", "args": [[49.0, *hidden]]},
    ]
'''

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

MASTER = """# %% [markdown]
# # The orchard

# %%
from autograder import ask, check, progress, submit

# %% exercise="Q1"

# %% exercise="Q2"

# %% exercise="Q3"

# %% exercise="Q4"
"""

RIGHT = {
    "Q1": 'ask("Q1").respond([False, True])',
    "Q2": "trees = 12",
    "Q3": 'import sympy as sp\nw, l = sp.symbols("w l")\nhedge = 2 * w + 2 * l',
    "Q4": "def heaviest(weights):\n    return max(weights)",
}
START = "from autograder import ask, check, progress, submit"


def make_course(root: Path) -> Course:
    """Write the course at ``root`` and load it."""
    (root / "notebooks/questions").mkdir(parents=True)
    (root / "notebooks/questions/orchard.toml").write_text(QUESTIONS)
    (root / "notebooks/1_orchard.ipynb").write_text(notebook([START]))
    (root / "notebooks/source").mkdir()
    (root / "notebooks/source/1_orchard.py").write_text(MASTER)
    (root / "solutions/answers").mkdir(parents=True)
    (root / "solutions/answers/orchard.toml").write_text(ANSWERS)
    # Not in a package `solutions`: one process knows one, and other tests load the real one.
    (root / "orchard_reference.py").write_text(SOLUTIONS)
    (root / "pyproject.toml").write_text('[project]\nname = "orchard"\nversion = "0.1"\n')
    return load_course(root)


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
    path = folder / student / "1_orchard.ipynb"
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
