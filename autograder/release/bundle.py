"""``autograder release``: what students download."""

from __future__ import annotations

import json
import shutil
import tempfile
from collections.abc import Callable, Collection
from dataclasses import dataclass
from pathlib import Path

from autograder.authoring.build import build_student_notebooks
from autograder.authoring.bundle_pyproject import bundle_pyproject
from autograder.authoring.practice_key import PRACTICE, practice_files
from autograder.course import Course
from autograder.course.places import FILE as PLACES
from autograder.course.settings import setting_lines
from autograder.errors import CourseError, UsageError
from autograder.marking.snapshots import SNAPSHOTS
from autograder.release import practice_workflow
from autograder.release.file_rules import LeftOut, left_out, student_files
from autograder.release.leaks import leaks
from autograder.release.readme import student_readme
from autograder.release.take_snapshots import chapter_snapshots


@dataclass(frozen=True)
class Bundle:
    """A finished bundle, and what stayed here.

    ``blind`` names the known mistakes that its checks cannot tell.
    """

    folder: Path
    files: tuple[Path, ...]
    blind: tuple[str, ...]
    left_out: tuple[LeftOut, ...]


# Responses are not ignored: whoever hands in by pushing hands them in too.
_IGNORED = ".venv/\n__pycache__/\nresponses/*.lock\nresponses/*.tmp\nsubmission.zip\nuv.lock\n"


def release(
    course: Course,
    target: Path,
    practice: Collection[str] = (),
    report: Callable[[str], None] = lambda step: None,
) -> Bundle:
    """Write the student bundle to ``target``, whole or not at all.

    Raises:
        UsageError: if the folder exists and holds something, or a practice chapter does not exist.
        CourseError: if anything of the key were in the bundle.
    """
    if target.exists() and (not target.is_dir() or any(target.iterdir())):
        raise UsageError(f"{target} is not empty; name a new folder, or remove that one first.")
    practised = list(practice_files(course, practice)) if practice else []
    target.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=target.parent, prefix=".release-") as temporary:
        folder = Path(temporary) / "bundle"
        report("copying")
        for name, path in student_files(course):
            _copy(path, folder / name)
        report("notebooks")
        for built in build_student_notebooks(course):
            _write(folder / built.path.relative_to(course.root), built.text)
        report("snapshots")
        blind, checked = [], set()
        for chapter in course.chapters:
            snapshots, missed = chapter_snapshots(course, chapter)
            blind += missed
            checked |= {id for id, snapshot in snapshots.items() if snapshot.get("checked")}
            text = json.dumps(snapshots, indent=1)
            _write(folder / SNAPSHOTS / f"{chapter.name}.json", text + "\n")
        _write(folder / "pyproject.toml", bundle_pyproject(course, "-student"))
        if course.personal and course.places is not None:
            _write(folder / PLACES, course.places.text())
        _write(folder / "README.md", student_readme(course, practice, checked))
        _write(folder / ".gitignore", _IGNORED)
        for file in practised:
            _copy(course.root / file, folder / PRACTICE / file)
        if practised:
            _write(folder / practice_workflow.PATH, practice_workflow.TEXT)
        if practised and (settings := setting_lines(course.root)):
            _write(folder / PRACTICE / "pyproject.toml", "\n".join(settings) + "\n")
        report("looking for answers")
        found = next(leaks(course, folder, practice), None)
        if found is not None:
            raise CourseError(f"Nothing was released: {found}")
        folder.chmod(0o755)
        if target.exists():
            target.rmdir()
        shutil.move(folder, target)
    files = tuple(sorted(path.relative_to(target) for path in target.rglob("*") if path.is_file()))
    return Bundle(target, files, tuple(blind), tuple(left_out(course)))


def _copy(source: Path, target: Path) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(source, target)


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8", newline="\n")
