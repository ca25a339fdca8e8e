"""A fingerprint of everything that can change a mark: another one, and work is graded anew."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from autograder.course.folders import (
    ANSWERS,
    DATA,
    MASTERS,
    NOTEBOOKS,
    QUESTIONS,
    SOLUTIONS,
)
from autograder.course.toml_file import unreadable

if TYPE_CHECKING:
    from autograder.course.course import Course

_PACKAGE = Path(__file__).parents[1]
_MARKS_NOTHING = ("authoring", "cli", "gradebook", "release", "reports")  # folders of the package
_LARGE_FILE = 32 * 2**20  # bytes


def course_version(course: Course) -> str:
    """A fingerprint of everything that can change a mark.

    That is the key, what student code finds around it, the limits on it, and the autograder.
    Of files only the contents count, since a fresh checkout has other times; of a large one,
    which no course has so far, the size and the ends.
    """
    digest = hashlib.sha256()
    digest.update(f"{course.settings}\0{sorted(course.demo_cells)}\0".encode())
    if course.personal:
        digest.update(f"{course.others_count}\0".encode())
        digest.update(f"{course.places.text() if course.places else ''}\0".encode())
    for top, folder, pattern, left_out in (
        (course.root, QUESTIONS, "*.toml", ()),
        (course.root, ANSWERS, "*.toml", ()),
        (course.root, SOLUTIONS, "**/*.py", ()),
        (course.root, NOTEBOOKS, "**/*.py", (MASTERS.name,)),
        (course.root, DATA, "**/*", ()),
        (_PACKAGE, ".", "**/*.py", _MARKS_NOTHING),
    ):
        for path in sorted((top / folder).glob(pattern)):
            inside = path.relative_to(top / folder)
            if inside.parts[0] in left_out or "__pycache__" in inside.parts:
                continue
            if path.is_file():
                digest.update(f"{folder}/{inside.as_posix()}\0".encode())
                _digest_file(path, digest.update)
    return digest.hexdigest()[:16]


def _digest_file(path: Path, update: Callable[[bytes], object]) -> None:
    try:
        with path.open("rb") as file:
            size = file.seek(0, os.SEEK_END)
            file.seek(0)
            update(f"{size}\0".encode())
            update(file.read(_LARGE_FILE // 2))
            file.seek(max(_LARGE_FILE // 2, size - _LARGE_FILE // 2))
            update(file.read(_LARGE_FILE // 2))
    except OSError as error:
        raise unreadable(path, error) from None
