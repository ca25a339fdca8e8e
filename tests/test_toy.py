"""The small course of the tests: sound as a whole, described truly, and the only one."""

from __future__ import annotations

import ast
import re
from pathlib import Path

from autograder.authoring.proof import prove_course
from tests import toy
from tests.toy import make_toy

TESTS = Path(__file__).parent
# A course of its own that was made by `autograder new`, and pictures in a copy of the real one.
OTHERS = ("courses", "browser/screenshots.py")


def test_the_orchard_is_a_sound_course(tmp_path: Path):
    """Of the kitchen and the cellar, `test_proof` asks the same."""
    course = make_toy(tmp_path / "course", "orchard")
    course.write_notebooks()
    assert prove_course(course.root, mutants=False) == []


def test_its_table_of_contents_is_true(tmp_path: Path):
    rows = re.findall(r"^\|.*\| (Q[\d.]+) +\| (\w+) +\| (\d+) +\|", toy.__doc__ or "", re.M)
    course = make_toy(tmp_path / "course", "kitchen", "cellar", "orchard").load()
    assert rows == [(q.id, q.kind, f"{q.points:g}") for q in course.questions.values()]


def test_every_file_of_it_belongs_to_a_chapter():
    files = {
        path.relative_to(toy.COURSE).as_posix()
        for path in toy.COURSE.rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }
    assert files == set(toy.files_of("kitchen", "cellar", "orchard"))


def test_no_test_writes_a_chapter_of_its_own():
    """Its title is what a file of questions begins with; a question alone goes in by `add`."""
    chapters = [
        path.relative_to(TESTS).as_posix()
        for path in sorted(TESTS.rglob("*.py"))
        if not path.relative_to(TESTS).as_posix().startswith(OTHERS)
        for text in texts_of(path)
        if re.match(r"\s*title = .*\[\[question\]\]", text, re.S)
    ]
    assert chapters == []


def texts_of(path: Path) -> list[str]:
    """All texts in the code of a file."""
    nodes = ast.walk(ast.parse(path.read_text(encoding="utf-8")))
    return [n.value for n in nodes if isinstance(n, ast.Constant) and isinstance(n.value, str)]
