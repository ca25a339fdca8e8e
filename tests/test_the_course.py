"""The course that is shipped: it proves itself, and its notebooks are what the masters give."""

from __future__ import annotations

from pathlib import Path

import pytest

from autograder.authoring.build import stale_notebooks
from autograder.authoring.proof import prove_course
from autograder.cli import main
from autograder.course import load_course
from autograder.errors import CourseError

ROOT = Path(__file__).parent.parent


def test_the_course_proves_itself():
    """With every mutant and every variant, anew where a source has changed since the last time."""
    assert prove_course(ROOT) == []


def test_the_notebooks_are_what_the_masters_give():
    assert stale_notebooks(load_course(ROOT)) == []


def test_a_mistyped_course_folder_is_named_and_not_searched_for_above():
    with pytest.raises(CourseError, match=r"no course in .*notebooks"):
        load_course(ROOT / "notebooks")


def test_build_check_of_the_shipped_course_ends_with_status_0(capsys):
    assert main(["--course", str(ROOT), "build", "--check"]) == 0
    assert capsys.readouterr().out == ""
