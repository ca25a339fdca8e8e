"""Where the running notebook lies, and its course, whose packages it can then import.

A kernel starts in its notebook's folder, but need not stay there (``%cd``), and Visual Studio Code
can be told to start kernels in the folder that is open. What is kept and handed in must not depend
on that.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from autograder.course import find_course_root
from autograder.course.folders import NOTEBOOKS
from autograder.course.own_code import put_first
from autograder.errors import CourseError
from autograder.language import N_, _
from autograder.student.frontend import VSCODE_FILE, running_shell

COURSE = "AUTOGRADER_COURSE"  # names the course outright
OUTSIDE = N_(
    "This notebook lies outside of its course, so its questions and data are missing. Move it into "
    "the folder notebooks of the course and open it there; or run `%env AUTOGRADER_COURSE=PATH`, "
    "with the path of the course's folder, as the first cell, after a restart of the kernel."
)


def notebook_folder() -> Path:
    """The folder of the notebook that is running, as far as that is known, or else the working one.

    Visual Studio Code says where it is; other kernels were started there.
    """
    holding = [folder for folder in _candidates() if any(folder.glob("*.ipynb"))]
    in_course = (folder for folder in holding if _in_course(folder))
    return next(in_course, holding[0] if holding else Path.cwd())


def notebooks_folder(course_root: Path) -> Path:
    """The folder of the notebook that is running, or else the course's own notebooks."""
    here = notebook_folder()
    return here if any(here.glob("*.ipynb")) else course_root / NOTEBOOKS


def _candidates() -> Iterator[Path]:
    shell = running_shell()
    if shell is not None and hasattr(shell, "kernel"):
        told = shell.user_ns.get(VSCODE_FILE)
        if isinstance(told, str):
            yield Path(told).parent
        yield Path(shell.starting_dir)
    with suppress(OSError):  # it was removed
        yield Path.cwd()


def _in_course(folder: Path) -> bool:
    if os.environ.get(COURSE):
        return True  # wherever it is
    try:
        find_course_root(folder)
    except CourseError:
        return False
    return True


def course_of_notebook() -> Path:
    """The folder of the course that the running notebook belongs to.

    Raises:
        CourseError: if there is none; the sentence tells a student what to do.
    """
    try:
        root = find_course_root(None if os.environ.get(COURSE) else notebook_folder()).resolve()
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
