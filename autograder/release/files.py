"""Which files of a course may go where: by what is allowed, never by what is not."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path, PurePosixPath

from autograder.course import ANSWERS, QUESTIONS, Course

_ENGINE = frozenset({".py", ".js", ".mjs", ".css", ".json"})
_DATA = frozenset(
    {".py", ".npz", ".npy", ".csv", ".png", ".jpg", ".jpeg", ".json", ".txt", ".md", ".g2o"}
)
_NEVER = frozenset({"__pycache__", "responses", ".ipynb_checkpoints", "node_modules"})


def engine_files() -> Iterator[tuple[PurePosixPath, Path]]:
    """The autograder itself, as it is installed here: name in the bundle, and file."""
    root = Path(__file__).parents[1]
    for path in _under(root, _ENGINE):
        yield PurePosixPath("autograder", *path.relative_to(root).parts), path


def student_files(course: Course) -> Iterator[tuple[PurePosixPath, Path]]:
    """What of a course may be copied to students as it is; the notebooks are built for them."""
    yield from engine_files()
    yield from _in(course, "data", _DATA)
    for path in sorted((course.root / "notebooks").glob("*.py")):
        yield _name(course, path), path
    for folder in sorted((course.root / "notebooks").iterdir()):
        # Packages of pictures and helpers; the masters in `source` are no package.
        if (folder / "__init__.py").exists() and folder.name not in _NEVER:
            yield from _in(course, f"notebooks/{folder.name}", _ENGINE)
    yield from _in(course, str(QUESTIONS), frozenset({".toml"}))
    for name in ("LICENSE", "LICENSE.txt"):
        if (course.root / name).is_file():
            yield PurePosixPath(name), course.root / name


def grader_files(course: Course) -> Iterator[tuple[PurePosixPath, Path]]:
    """What grading needs: the same, and the key with its references."""
    yield from student_files(course)
    # The masters' numbers give the chapters their order.
    yield from _in(course, "notebooks/source", frozenset({".py"}))
    yield from _in(course, str(ANSWERS), frozenset({".toml"}))
    for path in _under(course.root / "solutions", frozenset({".py"})):
        yield _name(course, path), path


def _in(
    course: Course, folder: str, suffixes: frozenset[str]
) -> Iterator[tuple[PurePosixPath, Path]]:
    for path in _under(course.root / folder, suffixes):
        yield _name(course, path), path


def _name(course: Course, path: Path) -> PurePosixPath:
    return PurePosixPath(*path.relative_to(course.root).parts)


def _under(folder: Path, suffixes: frozenset[str]) -> Iterator[Path]:
    """The files below a folder with an allowed ending; links and hidden files are left out."""
    for path in sorted(folder.rglob("*")) if folder.is_dir() else []:
        parts = path.relative_to(folder).parts
        hidden = any(part in _NEVER or part.startswith(".") for part in parts)
        if path.is_file() and not path.is_symlink() and path.suffix in suffixes and not hidden:
            yield path
