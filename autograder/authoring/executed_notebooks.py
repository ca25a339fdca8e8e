"""Remembers which solved notebooks have been run, so that only what changed runs again.

What a notebook prints follows from its code, from the questions and the key of its chapter with the
modules that the key names, from what notebooks import (``data`` and the packages beside them) and
from the engine. While all of that stays, the outputs on disk are those that a run would give.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import nbformat

from autograder.authoring.practice_key import module_file, needed_modules
from autograder.course import Chapter, Course
from autograder.course.folders import ANSWERS, DATA, MASTERS, NOTEBOOKS, QUESTIONS

CACHE = Path(".build_cache/executed.json")
_ENGINE = Path(__file__).parents[1]


class Executed:
    """The notebooks of a course that have been run, by the names of their masters."""

    def __init__(self, course: Course) -> None:
        self._course = course
        self._path = course.root / CACHE
        try:
            known = json.loads(self._path.read_text(encoding="utf-8"))
        except (OSError, ValueError):
            known = {}
        self._known: dict[str, object] = known if isinstance(known, dict) else {}

    def take_outputs(self, notebook: Any, chapter: Chapter | None, stem: str, path: Path) -> bool:
        """Put the outputs on disk into a notebook, if a run would give the same; says whether."""
        known = self._known.get(stem)
        if not isinstance(known, dict) or not path.exists():
            return False
        text = path.read_text(encoding="utf-8")
        if known != self._entry(notebook, chapter, text):
            return False
        before = [cell for cell in nbformat.reads(text, 4).cells if cell.cell_type == "code"]
        now = [cell for cell in notebook.cells if cell.cell_type == "code"]
        for cell, old in zip(now, before, strict=True):
            cell.outputs, cell.execution_count = old.outputs, old.execution_count
        return True

    def remember(self, notebook: object, chapter: Chapter | None, stem: str, text: str) -> None:
        """Note that a notebook has been run, and what came of it."""
        self._known[stem] = self._entry(notebook, chapter, text)
        self._path.parent.mkdir(exist_ok=True)
        self._path.write_text(json.dumps(self._known, indent=1), encoding="utf-8", newline="\n")

    def _entry(self, notebook: Any, chapter: Chapter | None, text: str) -> dict[str, str]:
        code = [cell.source for cell in notebook.cells if cell.cell_type == "code"]
        digest = hashlib.sha256(json.dumps(code).encode())
        digest.update(surroundings(self._course, chapter).encode())
        return {"follows_from": digest.hexdigest(), "outputs": _outputs_digest(text)}


def surroundings(course: Course, chapter: Chapter | None) -> str:
    """A fingerprint of all that a chapter's notebook meets when it runs."""
    digest = hashlib.sha256()
    for path in [*_shared(course.root), *_of_chapter(course, chapter)]:
        digest.update(f"{path}\0{_content(path, path.stat().st_mtime_ns)}\0".encode())
    return digest.hexdigest()


def _shared(root: Path) -> Iterator[Path]:
    for folder, pattern in ((root / NOTEBOOKS, "**/*.py"), (_ENGINE, "**/*.py")):
        for path in sorted(folder.glob(pattern)):
            if path.parent != root / MASTERS:
                yield path
    for path in sorted((root / DATA).rglob("*")):
        if path.is_file() and "__pycache__" not in path.parts:
            yield path


def _of_chapter(course: Course, chapter: Chapter | None) -> Iterator[Path]:
    if chapter is None:
        return
    yield course.root / QUESTIONS / f"{chapter.name}.toml"
    yield course.root / ANSWERS / f"{chapter.name}.toml"
    for module in sorted(needed_modules(course, [chapter.name])):
        yield module_file(course, module)


@cache
def _content(path: Path, modified: int) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _outputs_digest(text: str) -> str:
    """A fingerprint of the outputs alone: prose may change without a run."""
    cells = json.loads(text)["cells"]
    outputs = [cell["outputs"] for cell in cells if cell["cell_type"] == "code"]
    return hashlib.sha256(json.dumps(outputs).encode()).hexdigest()
