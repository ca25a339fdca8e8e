"""Lets a notebook import its own course's packages, and no other course's of the same name.

Every course has a package ``data``, so none is installed: the folder of the course goes to the head
of the import path once the notebook asks for anything of the engine.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable
from pathlib import Path

from autograder.course import find_course_root
from autograder.errors import CourseError

OWN = ("data", "notebooks", "solutions")

OUTSIDE = (
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
        raise CourseError(OUTSIDE) from None
    if not root.is_dir():
        raise CourseError(
            f"AUTOGRADER_COURSE names {root}, which does not exist; "
            "correct it with %env, or remove it and open the notebook in its course."
        )
    return root


def put_course_first() -> None:
    """Make ``import data`` find the course's own, wherever else a package of that name lies."""
    try:
        root = course_of_notebook()
    except CourseError:
        return  # said when a question is asked
    here = str(root)
    if sys.path[:1] != [here]:
        sys.path[:] = [here, *(entry for entry in sys.path if entry != here)]
    _forget_others(root, OWN)


def _forget_others(root: Path, names: Iterable[str]) -> None:
    """Forget packages of those names that were imported from another folder, so far unused."""
    for name in names:
        module = sys.modules.get(name)
        file = getattr(module, "__file__", None)
        own = root / name / "__init__.py"
        if file and own.is_file() and not os.path.samefile(file, own):
            for loaded in [*sys.modules]:
                if loaded == name or loaded.startswith(f"{name}."):
                    del sys.modules[loaded]
