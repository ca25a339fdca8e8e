"""A graded class of three, made once; each test gets a copy that it may change."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import pytest

from autograder.cli import main
from autograder.course import Course, load_course
from tests.classroom import hand_in, make_course


class Classroom(NamedTuple):
    """A course, what was handed in, and where the grades are."""

    course: Course
    work: Path
    grades: Path
    run: Callable[..., int]


@pytest.fixture(scope="session")
def graded_classroom(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = tmp_path_factory.mktemp("classroom")
    make_course(root / "course")
    hand_in(root / "work", "ada")
    hand_in(root / "work", "boole", Q2="trees = 7", Q3="hedge = ...")
    hand_in(root / "work", "=curie", Q2="trees = 3 + 4", Q4="def heaviest(w):\n    return min(w)")
    arguments = ["grade", str(root / "work"), "--out", str(root / "grades"), "--seed", "5"]
    assert main(["--course", str(root / "course"), *arguments]) == 0
    return root


@pytest.fixture
def classroom(graded_classroom: Path, tmp_path: Path) -> Classroom:
    shutil.copytree(graded_classroom / "grades", tmp_path / "grades")
    shutil.copytree(graded_classroom / "course", tmp_path / "course")

    def run(command: str, *arguments: str) -> int:
        out = ["--out", str(tmp_path / "grades")]
        return main(["--course", str(tmp_path / "course"), command, *out, *arguments])

    course = load_course(tmp_path / "course")
    return Classroom(course, graded_classroom / "work", tmp_path / "grades", run)
