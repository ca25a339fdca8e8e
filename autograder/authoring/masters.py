"""The masters ``notebooks/source/*.py``: prose and cells, with one line for each exercise."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

import jupytext

from autograder.authoring.asked_in_masters import (
    check_identity,
    check_pictures,
    check_predictions,
    check_stories,
    lines_of,
)
from autograder.authoring.master import Master, MasterCell, place_in
from autograder.course import Course
from autograder.course.folders import MASTERS, SOLUTIONS
from autograder.errors import CourseError, UsageError
from autograder.questions.nearest_name import nearest

_OF_THE_KEY = re.compile(rf"^[ \t]*(?:from|import)[ \t]+{SOLUTIONS.name}\b", re.MULTILINE)
_MARKS = ("exercise", "demo")


def read_masters(course: Course) -> list[Master]:
    """Every master of the course, in order.

    Raises:
        CourseError: if a question or a prediction is asked twice, in the wrong chapter, or never,
            if an exercise cell holds anything, if a picture is missing, or if nobody asks whose
            numbers a notebook has.
    """
    paths = sorted((course.root / MASTERS).glob("*.py"))
    if not paths:
        raise CourseError(f"There are no masters in {course.root / MASTERS}; write N_CHAPTER.py.")
    masters = [_read_master(course, path) for path in paths]
    placed = [cell.exercise for master in masters for cell in master.cells if cell.exercise]
    for id in course.questions:
        if (times := placed.count(id)) != 1:
            raise CourseError(
                f"{id} is asked {times} times in {MASTERS}"
                f"{lines_of(masters, f'exercise={chr(34)}{id}{chr(34)}')}; "
                f'give it exactly one cell # %% exercise="{id}".'
            )
    check_predictions(course, masters)
    check_stories(course, masters)
    check_identity(course, masters)
    check_pictures(course, masters)
    return masters


def _read_master(course: Course, path: Path) -> Master:
    name = path.stem.partition("_")[2]
    chapter = next((chapter for chapter in course.chapters if chapter.name == name), None)
    text = path.read_text(encoding="utf-8")
    notebook = jupytext.reads(text, fmt="py:percent")
    cells = []
    for cell in notebook.cells:
        _check_marks(path, text, cell.metadata)
        exercise = cell.metadata.get("exercise")
        if exercise is not None:
            where = place_in(path, text, f'exercise="{exercise}"')
            try:
                question = course.question(exercise)
            except UsageError:
                raise CourseError(
                    f"{where} asks {exercise!r}, which is in no file of notebooks/questions."
                ) from None
            if chapter is None or question.chapter != chapter.name:
                raise CourseError(
                    f"{where} asks {exercise}, which belongs to {question.chapter}; move it."
                )
            if cell.source.strip():
                raise CourseError(f"{where}: the exercise {exercise} holds code; leave it empty.")
        elif cell.cell_type == "code" and (found := _OF_THE_KEY.search(cell.source)):
            raise CourseError(
                f"{place_in(path, text, found[0])} imports {SOLUTIONS.name}, which students do not "
                "get; move what notebooks need to a package beside them, or to data."
            )
        demo = cell.metadata.get("demo") is True
        cells.append(MasterCell(cell.cell_type, cell.source, exercise, demo))
    return Master(path, chapter, tuple(cells))


def _check_marks(path: Path, text: str, metadata: Iterable[str]) -> None:
    """Whether what stands behind ``# %%`` is an exercise or a demo, if it looks like one."""
    for mark in metadata:
        near = nearest(mark, _MARKS)
        if near and mark not in _MARKS:
            raise CourseError(
                f"{place_in(path, text, mark)} marks a cell by {mark!r}; perhaps {near!r} is meant."
            )
