"""Packs what a student hands in."""

from __future__ import annotations

import os
import zipfile
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from autograder.course import Course
from autograder.errors import AutograderError
from autograder.exchange.identity import FILE
from autograder.intake.notebook_reader import SUBMITTED, Unreadable, read_notebook


@dataclass(frozen=True)
class Packed:
    """The zip that was written, and the names inside."""

    path: Path
    names: tuple[str, ...]


def pack_submission(course: Course, responses: Path) -> Packed:
    """Write ``submission.zip`` with the notebooks and the responses beside them.

    Raises:
        AutograderError: if there is no notebook to hand in or the zip cannot be written.
    """
    folder = Path.cwd() if any(Path.cwd().glob("*.ipynb")) else course.root / "notebooks"
    notebooks = sorted(path for path in folder.glob("*.ipynb") if _is_of_the_course(path, course))
    if not notebooks:
        raise AutograderError(
            f"There is no chapter of the course in {folder}; run submit() in one of its notebooks."
        )
    files = {path.name: path for path in notebooks} | {
        f"responses/{name}.json": responses / f"{name}.json"
        for name in sorted({*(chapter.name for chapter in course.chapters), FILE})
        if (responses / f"{name}.json").exists()
    }
    target = (responses if os.environ.get("AUTOGRADER_RESPONSES") else folder) / "submission.zip"
    unfinished = target.with_suffix(".zip.tmp")
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        with zipfile.ZipFile(unfinished, "w", zipfile.ZIP_DEFLATED) as archive:
            for name, path in files.items():
                archive.write(path, name)
            archive.writestr(SUBMITTED, datetime.now(UTC).isoformat(timespec="seconds"))
        os.replace(unfinished, target)
    except OSError as error:
        raise AutograderError(
            f"{target} could not be written ({error}); nothing was handed in. "
            "Free the disk or move the course to a folder of your own, and submit again."
        ) from None
    return Packed(target, tuple(files))


def _is_of_the_course(path: Path, course: Course) -> bool:
    """Whether a notebook is a chapter, by its name or, renamed, by the questions it asks."""
    if any(chapter.name in path.stem.casefold() for chapter in course.chapters):
        return True
    try:
        code = "\n".join(read_notebook(path.read_bytes()).cells)
    except (Unreadable, OSError):
        return False
    return any(f'"{id}"' in code for id in course.questions)
