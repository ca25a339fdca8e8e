"""A bundle and the grader go by the same settings: numbers, language, limits."""

from __future__ import annotations

import io
import json
import zipfile
from pathlib import Path

import pytest

from autograder.authoring.practice_key import PRACTICE
from autograder.course import Course, load_course
from autograder.course.places import make_places
from autograder.course.settings import read_settings
from autograder.errors import CourseError
from autograder.release.bundle import release
from autograder.release.gradescope.package import write_autograder_zip
from tests.toy import Toy, make_toy

SETTINGS = """[tool.autograder]
variants = "student"
others_numbers = "nothing"
language = "de"
packages = ["colorsys"]
notebook_seconds = 45
"""
STUDENTS = ("Ada Lovelace", "George Boole", "Emmy Noether", "Béla Bartók")


@pytest.fixture
def own(tmp_path: Path) -> Toy:
    """A course whose students have numbers of their own, dealt, and say who they are."""
    toy = make_toy(tmp_path / "course")
    toy.replace("notebooks/questions/kitchen.toml", "Three boxes", "{boxes} boxes")
    toy.replace(
        "notebooks/questions/kitchen.toml",
        'variable = "eggs"',
        'variable = "eggs"\nvariables = {boxes = [3, 5, 6, 8]}',
    )
    toy.replace("solutions/answers/kitchen.toml", "value = 12", 'value = "4*boxes"')
    toy.replace("solutions/answers/kitchen.toml", "value = 7", 'value = "4+boxes"')
    toy.append("notebooks/source/1_kitchen.py", "\n\n# %%\nme()\n")
    (toy.root / "pyproject.toml").write_text(SETTINGS)
    (toy.root / "places.toml").write_text(
        make_places({name: n for n, name in enumerate(STUDENTS)}).text()
    )
    return toy


def numbers_of_all(course: Course) -> list[object]:
    return [course.for_student(name).numbers("Q1.3") for name in STUDENTS]


def test_students_have_the_numbers_by_which_they_are_marked(own: Toy, tmp_path: Path):
    course = own.load()
    release(course, tmp_path / "bundle", ["kitchen"])
    bundled = load_course(tmp_path / "bundle")
    assert bundled.personal
    assert numbers_of_all(bundled) == numbers_of_all(course)
    assert len({json.dumps(numbers) for numbers in numbers_of_all(course)}) > 1
    assert read_settings(tmp_path / "bundle") == read_settings(own.root)
    assert read_settings(tmp_path / "bundle" / PRACTICE) == read_settings(own.root)
    assert 'me("Ada Lovelace")' in (tmp_path / "bundle/README.md").read_text()


def test_gradescope_marks_by_the_same_numbers(own: Toy, tmp_path: Path):
    course = own.load()
    write_autograder_zip(tmp_path / "autograder.zip", course)
    with zipfile.ZipFile(io.BytesIO((tmp_path / "autograder.zip").read_bytes())) as archive:
        archive.extractall(tmp_path / "image")
    graders = load_course(tmp_path / "image/course")
    assert numbers_of_all(graders) == numbers_of_all(course)
    assert read_settings(tmp_path / "image/course") == read_settings(own.root)


def test_a_course_without_settings_gives_a_bundle_without(tmp_path: Path):
    toy = make_toy(tmp_path / "course")
    (toy.root / "pyproject.toml").write_text("")
    release(toy.load(), tmp_path / "bundle")
    assert "[tool.autograder]" not in (tmp_path / "bundle/pyproject.toml").read_text()


def test_nobody_works_with_the_sheets_numbers_by_mistake(own: Toy, tmp_path: Path):
    own.replace("notebooks/source/1_kitchen.py", "me()", "None")
    with pytest.raises(CourseError, match=r"write me\(\) in a code cell of .*/1_kitchen.py"):
        release(own.load(), tmp_path / "bundle")
