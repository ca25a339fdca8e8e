"""``autograder build``: student and solved notebooks from the masters."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import nbformat

from autograder.authoring.assemble_notebook import assemble
from autograder.authoring.executed_notebooks import Executed
from autograder.authoring.masters import read_masters
from autograder.authoring.run_solved_notebook import run_solved_notebook
from autograder.course import Course
from autograder.course.folders import NOTEBOOKS, SOLVED


@dataclass(frozen=True)
class Built:
    """One notebook as it should be on disk."""

    path: Path
    text: str


def build_student_notebooks(course: Course) -> list[Built]:
    """What students open: stubs to fill in, no outputs."""
    return [
        _written(course, NOTEBOOKS / f"{master.stem}.ipynb", assemble(course, master, solved=False))
        for master in read_masters(course)
    ]


def build_solved_notebooks(
    course: Course, before: Callable[[str], None] = lambda name: None
) -> list[Built]:
    """The same notebooks solved and executed, with their outputs but without pictures.

    What has been run before and would print the same is not run again. ``before`` is called with
    each notebook's name before it runs.

    Raises:
        CourseError: if a cell raises; the sentence says where in the master, and what.
    """
    built = []
    executed = Executed(course)
    for master in read_masters(course):
        path = SOLVED / f"{master.stem}.ipynb"
        notebook = assemble(course, master, solved=True)
        known = executed.take_outputs(notebook, master.chapter, master.stem, course.root / path)
        if not known:
            before(master.stem)
            run_solved_notebook(notebook, course, master)
        written = _written(course, path, notebook)
        if not known:
            executed.remember(notebook, master.chapter, master.stem, written.text)
        built.append(written)
    return built


def unexecuted_solved_notebooks(course: Course) -> list[Built]:
    """The solved notebooks before they run: what `stale_notebooks` compares sources with."""
    return [
        _written(course, SOLVED / f"{master.stem}.ipynb", assemble(course, master, solved=True))
        for master in read_masters(course)
    ]


def stale_notebooks(course: Course) -> list[Path]:
    """The committed notebooks that differ from what the masters give.

    Of a solved notebook the sources and metadata are compared here; its outputs are compared by
    nbval, which runs it.
    """
    stale = [
        built.path
        for built in build_student_notebooks(course)
        if _on_disk(built.path) != built.text
    ]
    for built in unexecuted_solved_notebooks(course):
        if _without_outputs(_on_disk(built.path)) != built.text:
            stale.append(built.path)
    expected = {built.path.name for built in build_student_notebooks(course)}
    for folder in (NOTEBOOKS, SOLVED):
        stale += [
            path for path in (course.root / folder).glob("*.ipynb") if path.name not in expected
        ]
    return sorted(stale)


def write(built: list[Built]) -> list[Path]:
    """Write what differs from the disk; returns the paths written."""
    changed = [entry for entry in built if _on_disk(entry.path) != entry.text]
    for entry in changed:
        entry.path.parent.mkdir(parents=True, exist_ok=True)
        entry.path.write_text(entry.text, encoding="utf-8", newline="\n")
    return [entry.path for entry in changed]


def _written(course: Course, path: Path, notebook: object) -> Built:
    nbformat.validate(notebook)
    return Built(course.root / path, nbformat.writes(notebook, version=4) + "\n")


def _on_disk(path: Path) -> str:
    return path.read_text(encoding="utf-8") if path.exists() else ""


def _without_outputs(text: str) -> str:
    try:
        notebook = nbformat.from_dict(json.loads(text))
        for cell in notebook.cells:
            if cell.cell_type == "code":
                cell.outputs, cell.execution_count = [], None
        return str(nbformat.writes(notebook, version=4)) + "\n"
    except (ValueError, AttributeError, TypeError):
        return ""  # missing, or damaged as by a merge conflict: it differs from any notebook
