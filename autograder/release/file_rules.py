"""Which files of a course may go where: a folder and a rule for each, and a reason for what stays.

The rules allow: what no rule names stays. In ``data`` and in packages beside the notebooks any file
goes, whatever its ending, unless there is a reason against it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from autograder.course import Course
from autograder.course.folders import ANSWERS, DATA, MASTERS, NOTEBOOKS, QUESTIONS, SOLUTIONS

_ENGINE = frozenset({".py", ".js", ".mjs", ".css", ".json", ".po"})
_CACHES = frozenset({"__pycache__", ".ipynb_checkpoints", "node_modules"})
_STUDENTS = frozenset({"responses", "submission.zip"})
# Folders with rules of their own.
_NOT_COPIED = frozenset({MASTERS.name, QUESTIONS.name, "snapshots"})
_PICKLES = frozenset({".pkl", ".pickle", ".joblib"})


@dataclass(frozen=True)
class LeftOut:
    """A file that stays here, by its path in the course, and why."""

    path: PurePosixPath
    reason: str


def engine_files() -> Iterator[tuple[PurePosixPath, Path]]:
    """The autograder itself, as it is installed here: name in the bundle, and file."""
    root = Path(__file__).parents[1]
    for path in _files(root):
        if path.suffix in _ENGINE and _reason(path, root) is None:
            yield PurePosixPath("autograder", *path.relative_to(root).parts), path


def student_files(course: Course) -> Iterator[tuple[PurePosixPath, Path]]:
    """What of a course may be copied to students as it is; the notebooks are built for them."""
    yield from engine_files()
    for folder in _shared_folders(course):
        for path in _files(folder):
            if _reason(path, course.root) is None:
                yield _name(course, path), path
    for path in sorted((course.root / NOTEBOOKS).glob("*.py")):
        yield _name(course, path), path
    for path in sorted((course.root / QUESTIONS).glob("*.toml")):
        yield _name(course, path), path
    for name in ("LICENSE", "LICENSE.txt"):
        if (course.root / name).is_file():
            yield PurePosixPath(name), course.root / name


def left_out(course: Course) -> list[LeftOut]:
    """What lies among the things for students and does not go to them.

    Caches and what a student's own work leaves are not worth a word.
    """
    found = []
    for folder in _shared_folders(course):
        for path in _files(folder):
            reason = _reason(path, course.root)
            if reason:
                found.append(LeftOut(_name(course, path), reason))
    shared = {folder.name for folder in _shared_folders(course)}
    for path in sorted((course.root / NOTEBOOKS).iterdir()):
        if path.is_dir():
            if path.name in shared | _NOT_COPIED | _CACHES | _STUDENTS or not any(_files(path)):
                continue
            reason = "it is not a package: without __init__.py no notebook can import it"
        elif path.suffix in (".py", ".ipynb") or path.name in _STUDENTS:
            continue
        else:
            reason = "beside the notebooks only modules are copied; move it to data"
        found.append(LeftOut(_name(course, path), _reason(path, course.root) or reason))
    return found


def grader_files(course: Course) -> Iterator[tuple[PurePosixPath, Path]]:
    """What grading needs: the same, and the key with its references."""
    yield from student_files(course)
    # The masters' numbers give the chapters their order.
    for folder, pattern in (
        (MASTERS, "*.py"),
        (ANSWERS, "*.toml"),
        (SOLUTIONS, "**/*.py"),
    ):
        for path in sorted((course.root / folder).glob(pattern)):
            if _reason(path, course.root) is None:
                yield _name(course, path), path


def _shared_folders(course: Course) -> list[Path]:
    """The data, and the packages beside the notebooks; the masters in `source` are no package."""
    packages = [
        folder
        for folder in sorted((course.root / NOTEBOOKS).iterdir())
        if (folder / "__init__.py").exists()
    ]
    return [course.root / DATA, *packages]


def _reason(path: Path, root: Path) -> str | None:
    """Why a file stays here: None if it may go, empty if that goes without saying."""
    parts = path.relative_to(root).parts
    if (_CACHES | _STUDENTS) & set(parts):
        return ""
    if any(part.startswith(".") for part in parts):
        return "it is hidden: its name or its folder's begins with a dot"
    if path.is_symlink():
        return "it is a link, which would lead nowhere in the bundle"
    if path.suffix in _PICKLES or (path.is_file() and _is_pickle(path)):
        return "it is a pickle, which runs code where it is loaded; store plain data"
    return None


def _is_pickle(path: Path) -> bool:
    """Whether a file begins as one of protocol 2 or newer does."""
    with path.open("rb") as file:
        begin = file.read(2)
    return len(begin) == 2 and begin[0] == 0x80 and 2 <= begin[1] <= 5


def _files(folder: Path) -> Iterator[Path]:
    for path in sorted(folder.rglob("*")) if folder.is_dir() else []:
        if path.is_symlink() or path.is_file():
            yield path


def _name(course: Course, path: Path) -> PurePosixPath:
    return PurePosixPath(*path.relative_to(course.root).parts)
