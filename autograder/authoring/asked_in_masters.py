"""What masters must ask for: each prediction once and in its chapter, and whose numbers."""

from __future__ import annotations

import re
from collections.abc import Iterable
from urllib.parse import unquote

from autograder.authoring.master import Master
from autograder.course import Course
from autograder.course.folders import MASTERS, NOTEBOOKS
from autograder.errors import CourseError

_PICTURE = re.compile(r"!\[[^\]]*\]\(\s*<?([^)\s>]+)")
_ELSEWHERE = re.compile(r"[a-zA-Z][\w+.-]*:|/")  # a URL, an attachment, another machine's place


def check_predictions(course: Course, masters: list[Master]) -> None:
    """Each prediction is asked for once, in the chapter that it belongs to."""
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
                f"{lines_of(masters, f'predict({chr(34)}{id}{chr(34)}')}; "
                f'write predict("{id}") in one cell.'
            )


def check_stories(course: Course, masters: list[Master]) -> None:
    """The numbers of a story are read only where a question tells it."""
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


def check_identity(course: Course, masters: list[Master]) -> None:
    """Each student has their own numbers only if they say who they are."""
    if course.personal and course.varied and not any("me" in master.calls for master in masters):
        raise CourseError(
            'With variants = "student" somebody must ask students who they are, or all work with '
            "the sheet's numbers and are marked by others: write me() in a code cell of "
            f"{MASTERS.as_posix()}/{masters[0].path.name}, above its first question."
        )


def check_pictures(course: Course, masters: list[Master]) -> None:
    """Each picture that the prose shows by a relative path is there."""
    folder = course.root / NOTEBOOKS
    for master in masters:
        for path in (
            path
            for cell in master.cells
            if cell.kind == "markdown"
            for path in _PICTURE.findall(cell.source)
        ):
            if not (_ELSEWHERE.match(path) or (folder / unquote(path)).is_file()):
                raise CourseError(
                    f"{master.where(path)} shows the picture {path}, which does not exist; write "
                    f"its path as seen from {NOTEBOOKS.as_posix()}/, such as ../data/picture.png."
                )


def lines_of(masters: Iterable[Master], sought: str) -> str:
    """All lines of the masters in which a text stands, in brackets; empty if there is none."""
    found = [
        f"{master.path.name}, line {number}"
        for master in masters
        for number, line in enumerate(master.path.read_text(encoding="utf-8").splitlines(), 1)
        if sought in line
    ]
    return f" ({'; '.join(found)})" if found else ""
