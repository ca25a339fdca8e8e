"""The small course of all tests: real files in ``course/``, copied by ``make_toy``, to be broken.

What is in it, and what a test can count on:

| chapter | question | kind | points | right | mistakes: credit |
|---|---|---|---|---|---|
| kitchen | Q1.1 | true_false | 3 | true, false, true | |
|         | Q1.2 | order      | 5 | cup, boil, stir, pour, stir_again, drink | two pairs |
|         | Q1.3 | number     | 2 | ``eggs = 12`` | added (7): 0.25, one box (4): 0 |
|         | Q1.4 | expression | 4 | ``rim = 2*a + 2*b`` | half the rim: 0.5, the area: 0 |
|         | Q1.5 | function   | 4 | ``mean_weight`` | the sum: 0.25, the middle: 0.5 |
| cellar  | Q2.1 | number     | 1 | ``share = 0.33`` | the closed ones: 0.5, open to closed: 0.25 |
| orchard | Q1   | true_false | 2 | false, true | |
|         | Q2   | number     | 2 | ``trees = 12`` | added (7): 0.25, one row (4): 0 |
|         | Q3   | expression | 2 | ``hedge = 2*w + 2*l`` | each side once: 0.5, the area: 0 |
|         | Q4   | function   | 4 | ``heaviest`` | forgets the first: 0.5, the lightest: 0.25 |

``make_toy(root)``             the kitchen and the cellar: every kind, two chapters, 19 points
``make_toy(root, "orchard")``  one chapter of 10 points, which ``tests/classroom.py`` hands in
``toy.add(...)``               a question of a test's own, with its key and its reference
``toy.set(...)``               a setting
``toy.replace(...)``           one place changed, to see who notices
``toy.line_of(...)``           the line that should be named
``refusal(toy)``               the one sentence with which it is refused
``market.make_market(root)``   the kitchen with three questions of each student's own numbers

The kitchen's reference is ``solutions.kitchen``: the fixture ``toy`` takes the real course's
package out for so long. The orchard's lies outside of ``solutions``, so a process can mark it and
the real course in turns.
"""

from __future__ import annotations

import json
import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from autograder.authoring.build import (
    build_student_notebooks,
    unexecuted_solved_notebooks,
    write,
)
from autograder.course import Course, load_course
from autograder.errors import CourseError

COURSE = Path(__file__).parent / "course"
REFERENCES = {"kitchen": "solutions/kitchen.py", "orchard": "orchard_reference.py"}


@dataclass(frozen=True)
class Toy:
    """A copy of the course, or of some of its chapters, under ``root``."""

    root: Path

    def load(self) -> Course:
        return load_course(self.root)

    def replace(self, file: str, old: str, new: str) -> None:
        """Change one place of one file; the place must be there exactly once."""
        path = self.root / file
        text = path.read_text(encoding="utf-8")
        assert text.count(old) == 1, f"{old!r} stands {text.count(old)} times in {file}"
        path.write_text(text.replace(old, new), encoding="utf-8")

    def line_of(self, file: str, text: str) -> int:
        """The line of a file in which a text begins that must be there."""
        before, found, _ = (self.root / file).read_text(encoding="utf-8").partition(text)
        assert found, f"{text!r} does not stand in {file}"
        return before.count("\n") + 1

    def append(self, file: str, text: str) -> None:
        with (self.root / file).open("a", encoding="utf-8") as stream:
            stream.write(text)

    def add(self, chapter: str, question: str, answer: str, reference: str = "") -> Toy:
        """Ask a question more: its tables, those of its key, and the code that these name."""
        self.append(f"notebooks/questions/{chapter}.toml", question)
        self.append(f"solutions/answers/{chapter}.toml", answer)
        if reference:
            self.append(REFERENCES[chapter], reference)
        return self

    def set(self, settings: str) -> Toy:
        """Write lines into the table ``[tool.autograder]``, the last of ``pyproject.toml``."""
        self.append("pyproject.toml", settings + "\n")
        return self

    def write_notebooks(self) -> None:
        """Build the student notebooks, and the solved ones without running them."""
        course = self.load()
        write(build_student_notebooks(course))
        write(unexecuted_solved_notebooks(course))

    def solved_cells(self, stem: str) -> list[dict[str, Any]]:
        """The cells of a solved notebook, as JSON."""
        text = (self.root / "solutions/notebooks" / f"{stem}.ipynb").read_text(encoding="utf-8")
        cells: list[dict[str, Any]] = json.loads(text)["cells"]
        return cells


def make_toy(root: Path, *chapters: str) -> Toy:
    """Copy the sources of some chapters, the kitchen and the cellar where none is named."""
    chapters = chapters or ("kitchen", "cellar")
    for file in files_of(*chapters):
        (root / file).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(COURSE / file, root / file)
    return Toy(root)


def files_of(*chapters: str) -> list[str]:
    """The files that make up a course of these chapters; its notebooks are not built yet."""
    files = ["pyproject.toml"]
    for chapter in chapters:
        (master,) = (COURSE / "notebooks/source").glob(f"*_{chapter}.py")
        files += [
            f"notebooks/source/{master.name}",
            f"notebooks/questions/{chapter}.toml",
            f"solutions/answers/{chapter}.toml",
        ]
        reference = REFERENCES.get(chapter, "")
        files += [reference] if reference else []
        files += ["solutions/__init__.py"] if reference.startswith("solutions/") else []
    return files


def text_of(file: str) -> str:
    """A file of the course as it stands here, for tests that read its tables alone."""
    return (COURSE / file).read_text(encoding="utf-8")


def refusal(course: Toy) -> str:
    """The one sentence with which a broken course is refused."""
    with pytest.raises(CourseError) as refused:
        assert course.load().key
    sentence = str(refused.value)
    assert "\n" not in sentence
    assert sentence.endswith(".")
    return sentence
