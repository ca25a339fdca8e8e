"""Lets a notebook import its own course's packages once it asks for anything of the engine."""

from __future__ import annotations

from pathlib import Path

from autograder.course import find_course_root
from autograder.course.own_code import put_first
from autograder.errors import CourseError
from autograder.language import N_, _

OUTSIDE = N_(
    "This notebook lies outside of its course, so its questions and data are missing. Move it into "
    "the folder notebooks of the course and open it there; or run `%env AUTOGRADER_COURSE=PATH`, "
    "with the path of the course's folder, as the first cell, after a restart of the kernel."
)


def course_of_notebook() -> Path:
    """The folder of the course that the running notebook belongs to.

    Raises:
        CourseError: if there is none; the sentence tells a student what to do.
    """
    try:
        root = find_course_root().resolve()
    except CourseError:
        raise CourseError(_(OUTSIDE)) from None
    if not root.is_dir():
        sentence = _(
            "AUTOGRADER_COURSE names {folder}, which does not exist; "
            "correct it with %env, or remove it and open the notebook in its course."
        )
        raise CourseError(sentence.format(folder=root))
    return root


def put_course_first() -> None:
    """Make ``import data`` find the course's own, wherever else a package of that name lies."""
    try:
        root = course_of_notebook()
    except CourseError:
        return  # said when a question is asked
    put_first(root)
