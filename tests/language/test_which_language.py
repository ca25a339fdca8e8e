"""The course says which language is spoken, and where it does not, a person in a notebook."""

from __future__ import annotations

from pathlib import Path

import pytest

from autograder import language
from autograder.course import load_course
from autograder.errors import CourseError
from autograder.language import _, n_
from tests.classroom import make_course
from tests.toy import Toy


def test_the_course_says_which_language_and_a_notebook_follows_the_person(
    monkeypatch: pytest.MonkeyPatch,
):
    assert _("Right") == "Right"
    monkeypatch.setenv("LANGUAGE", "xx:de_CH.UTF-8:en")
    assert _("Right") == "Right"  # grading does not look there
    language.follow_environment()
    assert _("Right") == "Richtig"
    assert n_("{count} point", "{count} points", 1) == "{count} Punkt"
    assert n_("{count} point", "{count} points", 0.5) == "{count} Punkte"
    language.use("en")
    assert _("Right") == "Right"


def test_an_unknown_language_is_refused(tmp_path: Path):
    make_course(tmp_path)
    Toy(tmp_path).set('language = "tlh"')
    with pytest.raises(CourseError, match="language"):
        load_course(tmp_path)
