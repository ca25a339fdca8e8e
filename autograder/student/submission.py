"""Packs what a student hands in."""

from __future__ import annotations

import os
import zipfile
from dataclasses import dataclass
from pathlib import Path

from autograder.course import Course
from autograder.errors import AutograderError


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
    chapters = {chapter.name for chapter in course.chapters}
    folder = Path.cwd() if any(Path.cwd().glob("*.ipynb")) else course.root / "notebooks"
    notebooks = sorted(
        path
        for path in folder.glob("*.ipynb")
        if any(path.stem.partition("_")[2].startswith(name) for name in chapters)
    )
    if not notebooks:
        raise AutograderError(
            f"There is no chapter of the course in {folder}; run submit() in one of its notebooks."
        )
    files = {path.name: path for path in notebooks} | {
        f"responses/{name}.json": responses / f"{name}.json"
        for name in sorted(chapters)
        if (responses / f"{name}.json").exists()
    }
    target = (responses if os.environ.get("AUTOGRADER_RESPONSES") else folder) / "submission.zip"
    unfinished = target.with_suffix(".zip.tmp")
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        with zipfile.ZipFile(unfinished, "w", zipfile.ZIP_DEFLATED) as archive:
            for name, path in files.items():
                archive.write(path, name)
        os.replace(unfinished, target)
    except OSError as error:
        raise AutograderError(
            f"{target} could not be written ({error}); nothing was handed in. "
            "Free the disk or move the course to a folder of your own, and submit again."
        ) from None
    return Packed(target, tuple(files))
