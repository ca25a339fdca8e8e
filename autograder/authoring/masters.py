"""The masters ``notebooks/source/*.py``: prose and cells, with one line for each exercise."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import jupytext

from autograder.course import Chapter, Course
from autograder.course.folders import MASTERS, SOLUTIONS
from autograder.errors import CourseError, UsageError
from autograder.questions.strict_reader import nearest

_CALL = re.compile(r"(?<![\w.])(\w+)\(")
_TELLS = re.compile(r"""(?<![\w.])numbers\(\s*["']([^"']*)["']""")
_OF_THE_KEY = re.compile(rf"^[ \t]*(?:from|import)[ \t]+{SOLUTIONS.name}\b", re.MULTILINE)
_MARKS = ("exercise", "demo")
_ASKS = re.compile(r"""\bpredict\(\s*["']([^"']*)["']""")


@dataclass(frozen=True)
class MasterCell:
    """A cell of a master: Markdown, code, or an exercise (then ``exercise`` is its id).

    ``demo`` says that the cell only shows something: no response needs it, and the grader leaves
    it out where it is unchanged.
    """

    kind: str
    source: str
    exercise: str | None = None
    demo: bool = False


@dataclass(frozen=True)
class Master:
    """One master; ``chapter`` is None for a notebook without questions."""

    path: Path
    chapter: Chapter | None
    cells: tuple[MasterCell, ...]

    @property
    def stem(self) -> str:
        """The notebook's file name without its ending, such as ``3_ransac``."""
        return self.path.stem

    def where(self, sought: str, further: int = 0) -> str:
        """The file, and the line where a text stands for the first time, or so many lines on."""
        return _where(self.path, self.path.read_text(encoding="utf-8"), sought, further)

    @property
    def calls(self) -> set[str]:
        """The names of the functions that its cells call."""
        code = (cell.source for cell in self.cells if cell.kind == "code")
        return {name for source in code for name in _CALL.findall(source)}

    @property
    def predictions(self) -> list[str]:
        """The ids of what is to be predicted in it."""
        code = (cell.source for cell in self.cells if cell.kind == "code")
        return [id for source in code for id in _ASKS.findall(source)]

    @property
    def stories(self) -> list[str]:
        """The names of the stories whose numbers it reads."""
        code = (cell.source for cell in self.cells if cell.kind == "code")
        return [name for source in code for name in _TELLS.findall(source)]


def read_masters(course: Course) -> list[Master]:
    """Every master of the course, in order.

    Raises:
        CourseError: if a question or a prediction is asked twice, in the wrong chapter, or never,
            if an exercise cell holds anything, or if nobody asks whose numbers a notebook has.
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
                f"{_lines(masters, f'exercise={chr(34)}{id}{chr(34)}')}; "
                f'give it exactly one cell # %% exercise="{id}".'
            )
    _check_predictions(course, masters)
    _check_stories(course, masters)
    _check_identity(course, masters)
    return masters


def _check_predictions(course: Course, masters: list[Master]) -> None:
    asked = [(id, master) for master in masters for id in master.predictions]
    for id, master in asked:
        if id not in course.predictions:
            raise CourseError(
                f"{master.where(id)} asks for the prediction {id!r}, which is in no file of "
                "notebooks/questions."
            )
        chapter = course.predictions[id].chapter
        if master.chapter is None or master.chapter.name != chapter:
            raise CourseError(
                f"{master.where(id)} asks for {id}, which belongs to {chapter}; move it."
            )
    for id in course.predictions:
        times = [other for other, _ in asked].count(id)
        if times != 1:
            raise CourseError(
                f"{id} is asked for {times} times in {MASTERS}"
                f"{_lines(masters, f'predict({chr(34)}{id}{chr(34)}')}; "
                f'write predict("{id}") in one cell.'
            )


def _check_stories(course: Course, masters: list[Master]) -> None:
    told = {
        str(written.table["story"]): None
        for written in course.varied.values()
        if "story" in written.table
    }
    for master in masters:
        for name in master.stories:
            if name not in told:
                raise CourseError(
                    f"{master.where(f'numbers({chr(34)}{name}')} reads the numbers of {name!r}; "
                    f"the stories that questions tell are {', '.join(told) or 'none'}."
                )


def _check_identity(course: Course, masters: list[Master]) -> None:
    """Each student has their own numbers only if they say who they are."""
    if course.personal and course.varied and not any("me" in master.calls for master in masters):
        raise CourseError(
            'With variants = "student" somebody must ask students who they are, or all work with '
            "the sheet's numbers and are marked by others: write me() in a code cell of "
            f"{MASTERS.as_posix()}/{masters[0].path.name}, above its first question."
        )


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
            where = _where(path, text, f'exercise="{exercise}"')
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
                f"{_where(path, text, found[0])} imports {SOLUTIONS.name}, which students do not "
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
                f"{_where(path, text, mark)} marks a cell by {mark!r}; perhaps {near!r} is meant."
            )


def _lines(masters: Iterable[Master], sought: str) -> str:
    """All lines of the masters in which a text stands, in brackets; empty if there is none."""
    found = [
        f"{master.path.name}, line {number}"
        for master in masters
        for number, line in enumerate(master.path.read_text(encoding="utf-8").splitlines(), 1)
        if sought in line
    ]
    return f" ({'; '.join(found)})" if found else ""


def _where(path: Path, text: str, sought: str, further: int = 0) -> str:
    """A master, and the line in it where a text stands for the first time, if it is there."""
    before, found, _ = text.partition(sought)
    line = f", line {before.count(chr(10)) + 1 + further}" if found else ""
    return f"{MASTERS.as_posix()}/{path.name}{line}"
