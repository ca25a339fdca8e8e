"""Finds a course and reads it: its settings, its chapters, their questions and predictions."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import Path

from autograder.course.course import Chapter, Course
from autograder.course.folders import (
    MASTERS,
    NOTEBOOKS,
    QUESTIONS,
)
from autograder.course.places import read_places
from autograder.course.predictions import Prediction
from autograder.course.questions import Written
from autograder.course.settings import read_settings
from autograder.course.toml_file import read_toml
from autograder.course.used_twice import reject_what_is_used_twice
from autograder.errors import CourseError
from autograder.language import use
from autograder.questions.nearest_name import meant
from autograder.questions.registry import load_kind
from autograder.questions.strict_reader import Place, Table, read_table
from autograder.questions.variables import Variables, read_variables

_FIELDS = ("title", "question", "story", "prediction")  # of a file of questions


def find_course_root(start: Path | None = None) -> Path:
    """The nearest folder, from ``start`` (default: here) upwards, that holds a course.

    The environment variable ``AUTOGRADER_COURSE`` names it outright.

    Raises:
        CourseError: if there is none.
    """
    given = os.environ.get("AUTOGRADER_COURSE")
    if given and start is None:
        return Path(given)
    here = (start or Path.cwd()).resolve()
    for folder in (here, *here.parents):
        if (folder / QUESTIONS).is_dir():
            return folder
    raise CourseError(
        f"There is no course in {here} or above it (a folder with {QUESTIONS}); "
        "change to the course's folder, or name it with --course."
    )


def load_course(root: Path | None = None) -> Course:
    """Read the questions and settings of the course at ``root`` (default: found from here).

    Raises:
        CourseError: if there is no course, a file cannot be read, or an id or a variable is used
            twice.
    """
    if root is None:
        root = find_course_root()
    elif not (root / QUESTIONS).is_dir():
        # Not the course of a folder above: that would hide a mistyped name.
        raise CourseError(f"There is no course in {root}: it has no folder {QUESTIONS}.")
    root = root.resolve()
    settings = read_settings(root)
    use(settings.language)
    for package in settings.kinds:
        load_kind(package, root)
    chapters = []
    for path in sorted((root / QUESTIONS).glob("*.toml"), key=_chapter_position(root)):
        text, table = read_toml(path, "write it or remove the file")
        title = _check_fields(table, Place(path.relative_to(root).as_posix(), text))
        entries = table.get("question", [])
        if not (isinstance(entries, list) and all(isinstance(entry, dict) for entry in entries)):
            place = Place(path.relative_to(root).as_posix(), text)
            raise place.error(
                "each question is a table that begins with [[question]]", ("question",)
            )
        stories = _read_stories(table.get("story", {}), text, path.relative_to(root))
        written = tuple(
            Written.read(entry, path.stem, text, n, stories) for n, entry in enumerate(entries)
        )
        questions = tuple(entry.question() for entry in written)
        told = {entry.table.get("story") for entry in written}
        tables = table.get("prediction", [])
        heard = {name: told_by for name, told_by in stories.items() if name in told}
        predictions = _read_predictions(tables, text, path.relative_to(root), heard)
        chapters.append(Chapter(path.stem, title, questions, written, predictions))
    if not chapters:
        raise CourseError(f"{root / QUESTIONS} holds no questions; add a CHAPTER.toml.")
    reject_what_is_used_twice(chapters)
    return Course(
        root,
        tuple(chapters),
        settings.limits,
        settings.kinds,
        personal=settings.variants == "student",
        others_count=settings.others_numbers == "count",
        places=read_places(root),
    )


def _check_fields(table: Table, place: Place) -> str:
    """The title of a file of questions, which holds nothing but what it may.

    Raises:
        CourseError: if there is none, or if there is anything else.
    """
    for name in table:
        if name not in _FIELDS:
            raise place.error(f"unknown field {name!r}; {meant(name, _FIELDS)}", (name,))
    title = table.get("title")
    if not isinstance(title, str):
        raise place.error(
            'a file of questions needs a title; write title = "..." in its first line'
        )
    return title


def _read_stories(stories: object, text: str, file: Path) -> dict[str, Variables]:
    place = Place(f"story in {file.as_posix()}", text, ("story",))
    if not isinstance(stories, dict):
        raise place.error("a story is a table such as [story.cloud]")
    return {
        name: read_variables(
            table, name, Place(f"story {name!r} in {file.as_posix()}", text, ("story", name))
        )
        for name, table in stories.items()
    }


def _read_predictions(
    tables: object, text: str, file: Path, stories: Mapping[str, Variables]
) -> tuple[Prediction, ...]:
    if not (isinstance(tables, list) and all(isinstance(table, dict) for table in tables)):
        raise Place(file.as_posix(), text).error(
            "each prediction is a table that begins with [[prediction]]", ("prediction",)
        )
    found = []
    for number, table in enumerate(tables):
        words = f"prediction {table.get('id', '?')!r} in {file.as_posix()}"
        place = Place(words, text, ("prediction", number))
        prediction = read_table(table, Prediction, place, chapter=file.stem)
        if prediction.story:
            if prediction.story not in stories:
                raise place.error("no question of this file tells that story", ("story",))
            try:
                prediction.with_numbers(stories[prediction.story].numbers(0))
            except CourseError as error:
                raise place.error(str(error).rstrip("."), ("prompt",)) from None
        found.append(prediction)
    return tuple(found)


def _chapter_position(root: Path) -> Callable[[Path], str]:
    """Sort key: the number in the master's file name, so chapters stand as in the notebooks."""
    numbers = {
        path.stem.partition("_")[2]: path.stem for path in (root / NOTEBOOKS).glob("[0-9]*_*.ipynb")
    } | {path.stem.partition("_")[2]: path.stem for path in (root / MASTERS).glob("[0-9]*_*.py")}
    return lambda path: numbers.get(path.stem, "~" + path.stem)
