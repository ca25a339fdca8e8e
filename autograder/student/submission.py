"""Packs what a student hands in."""

from __future__ import annotations

import json
import os
import re
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path, PurePosixPath
from typing import Any

from autograder.course import Course
from autograder.errors import AutograderError
from autograder.exchange.identity import FILE
from autograder.intake.notebook_reader import SUBMITTED, Unreadable, read_notebook
from autograder.language import _
from autograder.student.course_path import notebooks_folder

_ASKS = re.compile(r"^me\(", re.MULTILINE)


@dataclass(frozen=True)
class Packed:
    """The zip that was written, and the names inside."""

    path: Path
    names: tuple[str, ...]
    folder: Path  # of the notebooks


def pack_submission(
    course: Course, responses: Path, on_screen: Mapping[str, Any] | None = None
) -> Packed:
    """Write ``submission.zip`` with the notebooks and the responses beside them.

    ``on_screen`` is the running notebook, where the front end hands it out: it takes the place of
    the chapter's file, which the front end may never have saved.

    Raises:
        AutograderError: if there is no notebook to hand in or the zip cannot be written.
    """
    folder = notebooks_folder(course.root)
    notebooks = sorted(path for path in folder.glob("*.ipynb") if _is_of_the_course(path, course))
    if not notebooks:
        raise AutograderError(
            _(
                "There is no chapter of the course in {folder}; run submit() in one of its "
                "notebooks."
            ).format(folder=folder)
        )
    files: dict[str, Path | bytes] = {path.name: path for path in notebooks}
    if on_screen is not None:
        name = _place_of(on_screen, notebooks, course)
        files[name] = json.dumps(on_screen).encode()
    files |= {
        f"responses/{name}.json": responses / f"{name}.json"
        for name in sorted({*(chapter.name for chapter in course.chapters), FILE})
        if (responses / f"{name}.json").exists()
    }
    target = (responses if os.environ.get("AUTOGRADER_RESPONSES") else folder) / "submission.zip"
    unfinished = target.with_suffix(".zip.tmp")
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        with zipfile.ZipFile(unfinished, "w", zipfile.ZIP_DEFLATED) as archive:
            for name, content in files.items():
                if isinstance(content, bytes):
                    archive.writestr(name, content)
                else:
                    archive.write(content, name)
            archive.writestr(SUBMITTED, datetime.now(UTC).isoformat(timespec="seconds"))
        os.replace(unfinished, target)
    except OSError as error:
        raise AutograderError(
            _(
                "{file} could not be written ({reason}); nothing was handed in. "
                "Free the disk or move the course to a folder of your own, and submit again."
            ).format(file=target, reason=error)
        ) from None
    return Packed(target, tuple(files), folder)


def asks_for_a_name(folder: Path) -> bool:
    """Whether a notebook of the course asks students who they are."""
    for path in sorted(folder.glob("*.ipynb")):
        try:
            cells = read_notebook(path.read_bytes()).cells
        except (OSError, Unreadable):
            continue
        if any(_ASKS.search(cell) for cell in cells):
            return True
    return False


def _place_of(on_screen: Mapping[str, Any], notebooks: list[Path], course: Course) -> str:
    """The name under which the notebook on the screen is packed: its chapter's, if it has one."""
    names = [path.name for path in notebooks]
    colab = on_screen.get("metadata", {}).get("colab", {})
    own = PurePosixPath(str(colab.get("name") or "notebook.ipynb")).name
    if own in names:
        return own
    asked = _questions_of(json.dumps(on_screen).encode(), course)
    shared = {
        path.name: len(asked & _questions_of(path.read_bytes(), course)) for path in notebooks
    }
    most = max(shared.values(), default=0)
    return next(name for name in names if shared[name] == most) if most else own


def _is_of_the_course(path: Path, course: Course) -> bool:
    """Whether a notebook is a chapter, by its name or, renamed, by the questions it asks."""
    if any(chapter.name in path.stem.casefold() for chapter in course.chapters):
        return True
    try:
        return bool(_questions_of(path.read_bytes(), course))
    except OSError:
        return False


def _questions_of(notebook: bytes, course: Course) -> set[str]:
    """The questions that a notebook asks."""
    try:
        code = "\n".join(read_notebook(notebook).cells)
    except Unreadable:
        return set()
    return {id for id in course.questions if f'"{id}"' in code}
