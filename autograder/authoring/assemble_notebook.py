"""A notebook's cells from its master: prose, code, and for each exercise its question and stub."""

from __future__ import annotations

import hashlib
from collections import Counter

from msgspec.structs import replace
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from autograder import __all__
from autograder.authoring.line_in_key import with_line
from autograder.authoring.master import Master, MasterCell
from autograder.course import DEMO, Course
from autograder.course.folders import cell_id
from autograder.errors import CourseError
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
KERNEL = {
    "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
    "language_info": {"name": "python"},
}


def assemble(course: Course, master: Master, solved: bool) -> object:
    """The notebook's cells, each with an id that stays the same when others come or go."""
    notebook = new_notebook(metadata=KERNEL)
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
