"""``autograder build``: student and solved notebooks from the masters."""

from __future__ import annotations

import hashlib
import json
import os
import subprocess
import tempfile
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import nbformat
from msgspec.structs import replace
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from autograder import __all__
from autograder.authoring.executed_notebooks import Executed
from autograder.authoring.line_in_key import with_line
from autograder.authoring.masters import Master, MasterCell, read_masters
from autograder.authoring.raising_cells import raised
from autograder.course import DEMO, Course
from autograder.course.folders import NOTEBOOKS, SOLVED, cell_id
from autograder.errors import CourseError
from autograder.exchange.building import BUILDING
from autograder.questions.exercise import Exercise
from autograder.questions.exercise import heading as exercise_heading
from autograder.questions.question import Question
from autograder.questions.registry import kind_of

START_ID = "start"
# A package of this name on PyPI is another project; whoever installs that is told the same.
START = """\
# Run this cell first.
try:
    from autograder import {names}
except ImportError:
    raise ImportError(
        "The course is not installed for this kernel, and PyPI does not have it. "
        "In a terminal, go to the course's folder, which holds pyproject.toml, and type: "
        "pip install uv && uv run --extra lab jupyter lab. Then open this notebook there. "
        "On a hosted server, run %pip install -e .. here and restart the kernel."
    ) from None"""
_KERNEL = {
    "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
    "language_info": {"name": "python"},
}


@dataclass(frozen=True)
class Built:
    """One notebook as it should be on disk."""

    path: Path
    text: str


def build_student_notebooks(course: Course) -> list[Built]:
    """What students open: stubs to fill in, no outputs."""
    return [
        _written(
            course, NOTEBOOKS / f"{master.stem}.ipynb", _assemble(course, master, solved=False)
        )
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
        notebook = _assemble(course, master, solved=True)
        known = executed.take_outputs(notebook, master.chapter, master.stem, course.root / path)
        if not known:
            before(master.stem)
            _execute(notebook, course, master)
        written = _written(course, path, notebook)
        if not known:
            executed.remember(notebook, master.chapter, master.stem, written.text)
        built.append(written)
    return built


def unexecuted_solved_notebooks(course: Course) -> list[Built]:
    """The solved notebooks before they run: what `is_stale` compares sources with."""
    return [
        _written(course, SOLVED / f"{master.stem}.ipynb", _assemble(course, master, solved=True))
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


def _assemble(course: Course, master: Master, solved: bool) -> object:
    """The notebook's cells, each with an id that stays the same when others come or go."""
    notebook = new_notebook(metadata=_KERNEL)
    taken: Counter[str] = Counter()
    begun = False
    for cell in master.cells:
        if not begun and cell.kind == "code":
            notebook.cells.append(new_code_cell(_start(master), id=START_ID))
            begun = True
        if cell.exercise is None:
            make = new_markdown_cell if cell.kind == "markdown" else new_code_cell
            metadata = {"tags": [DEMO]} if cell.demo else {}
            notebook.cells.append(make(cell.source, id=_cell_id(cell, taken), metadata=metadata))
            continue
        question = course.question(cell.exercise)
        exercise = _exercise(course, question)
        asks = exercise.check is not None and course.personal and question.id in course.varied
        heading = _heading_without_numbers(course, question) if asks else exercise.heading
        notebook.cells.append(new_markdown_cell(heading, id=cell_id(question.id, "question")))
        if asks:  # a text that is written into the notebook would have the same numbers for all
            notebook.cells.append(
                new_code_cell(f'ask("{question.id}")', id=cell_id(question.id, "ask"))
            )
        source = exercise.solved if solved else exercise.stub
        notebook.cells.append(new_code_cell(source, id=cell_id(question.id, "response")))
        if exercise.check is not None:
            notebook.cells.append(new_code_cell(exercise.check, id=cell_id(question.id, "check")))
    return notebook


def _exercise(course: Course, question: Question) -> Exercise:
    try:
        return kind_of(question).exercise(question, course.key[question.id], course.root)
    except CourseError as error:
        raise CourseError(with_line(course, question, str(error))) from None


def _heading_without_numbers(course: Course, question: Question) -> str:
    """What stands above a question whose prompt is shown by a cell, to each with their numbers."""
    title = str(course.varied[question.id].table["title"])
    return exercise_heading(replace(question, title="your numbers" if "{" in title else title))


def _start(master: Master) -> str:
    names = ["ask", "check", "progress", "submit"]
    if any(cell.exercise for cell in master.cells):
        names.append("hint")
    if master.predictions:
        names[2:2] = ["predict", "predicted"]
    names += [name for name in ("me", "numbers", "practise") if name in master.calls]
    names.sort(key=__all__.index)
    return START.format(names=", ".join(names))


def _cell_id(cell: MasterCell, taken: Counter[str]) -> str:
    """An id that follows from the cell's own text, not from its place."""
    kind = "markdown" if cell.kind == "markdown" else "code"
    name = f"{kind}-{hashlib.sha256(cell.source.encode()).hexdigest()[:8]}"
    taken[name] += 1
    return name if taken[name] == 1 else f"{name}-{taken[name]}"


def _execute(notebook: Any, course: Course, master: Master) -> None:
    folder = course.root / SOLVED
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as responses:
        # Some ipykernels bring a debugger along, which warns of how newer Pythons are built.
        os.environ.setdefault("PYDEVD_DISABLE_FILE_VALIDATION", "1")
        # Responses of the author's own must neither be read nor overwritten.
        environment = {
            **os.environ,
            "AUTOGRADER_RESPONSES": responses,
            "AUTOGRADER_WIDGETS": "0",  # even if this runs inside of a notebook
            BUILDING: "1",
        }
        client = NotebookClient(
            notebook,
            timeout=600,
            kernel_name="python3",
            resources={"metadata": {"path": folder}},
        )
        try:
            # The kernel's own warnings concern its ports, not the author.
            client.execute(env=environment, stderr=subprocess.DEVNULL)
        except CellExecutionError:
            cell = next(c for c in notebook.cells if _raised(c))
            of_exercises = {
                cell_id(id, part): id for id in course.questions for part in ("response", "check")
            }
            raise CourseError(raised(master, cell, of_exercises.get(cell.id))) from None
    notebook.metadata = nbformat.from_dict(_KERNEL)  # without this machine's Python version
    for cell in notebook.cells:
        cell.metadata.pop("execution", None)
        if cell.cell_type == "code":
            cell.outputs = [kept for output in cell.outputs if (kept := _without_images(output))]


def _raised(cell: Any) -> bool:
    return any(output.output_type == "error" for output in cell.get("outputs", ()))


def _without_images(output: Any) -> object:
    """The output without pictures, which change with every version of Matplotlib.

    What stands beside a picture as text stays: nbval compares that.
    """
    if output.output_type not in ("display_data", "execute_result"):
        return output
    kept = {kind: data for kind, data in output.data.items() if not kind.startswith("image/")}
    if not kept:
        return None
    output.data = nbformat.from_dict(kept)
    return output


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
