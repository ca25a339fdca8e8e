"""Right work in other clothes, which must earn everything: ``solutions/variants``.

A question that asks for a function has a module of the function's name there. Each function in it
is a variant, but those that begin with an underscore or are imported. Questions that ask for a
variable have theirs in ``typed.toml``: by the question's id a list of texts, as students type them
into a cell.
"""

from __future__ import annotations

import importlib
import inspect
import tomllib
from collections.abc import Callable
from pathlib import Path

from autograder.course.course import Course
from autograder.course.own_code import OWN, put_first
from autograder.course.questions import Question
from autograder.errors import CourseError
from autograder.questions.strict_reader import Place

FOLDER = Path("solutions/variants")
TYPED = "typed.toml"


def has_right_work(course: Course) -> bool:
    """Whether the course has right work in other clothes at all."""
    return (course.root / FOLDER).is_dir()


def right_work_of(course: Course, question: Question) -> dict[str, object]:
    """The variants of a question by what they are called: functions, or texts as typed.

    Raises:
        CourseError: if a file cannot be read, or names something that there is not.
    """
    typed = _typed(course)
    if question.name is not None and (course.root / FOLDER / f"{question.name}.py").is_file():
        return {**right_functions(course.root, question.name)}
    return {text: text for text in typed.get(question.id, ())}


def module_of(course: Course, question: Question) -> str | None:
    """The dotted name of the module in which a question's variants stand, if it has one."""
    if question.name is None or not (course.root / FOLDER / f"{question.name}.py").is_file():
        return None
    return ".".join([*FOLDER.parts, question.name])


def unexpected_right_work(course: Course) -> list[str]:
    """The modules that are called after no question's function."""
    names = {question.name for question in course.questions.values()}
    return [
        f"{path.relative_to(course.root)} has the name of no question's function; "
        "rename it, or remove it."
        for path in sorted((course.root / FOLDER).glob("*.py"))
        if path.stem not in names and path.stem != "__init__"
    ]


def right_functions(root: Path, name: str) -> dict[str, Callable[..., object]]:
    """The variants of the function of this name; none if there is no such module.

    Raises:
        CourseError: if the module cannot be loaded.
    """
    if not (root / FOLDER / f"{name}.py").is_file():
        return {}
    module = ".".join([*FOLDER.parts, name])
    put_first(root, set(OWN))
    try:
        loaded = importlib.import_module(module)
    except Exception as error:  # the course's own code may do anything
        raise CourseError(f"{FOLDER / name}.py cannot be loaded: {error}.") from error
    return {
        style: function
        for style, function in vars(loaded).items()
        if inspect.isfunction(function)
        and function.__module__ == module
        and not style.startswith("_")
    }


def _typed(course: Course) -> dict[str, list[str]]:
    path = course.root / FOLDER / TYPED
    if not path.is_file():
        return {}
    try:
        text = path.read_text(encoding="utf-8")
        found = tomllib.loads(text)
    except (OSError, ValueError) as error:
        raise CourseError(f"{FOLDER / TYPED} cannot be read: {error}.") from error
    place = Place((FOLDER / TYPED).as_posix(), text)
    for id, texts in found.items():
        if id not in course.questions:
            raise place.error(f"it has {id!r}, which is not a question", (id,))
        if not (isinstance(texts, list) and all(isinstance(text, str) for text in texts)):
            raise place.error(f"it must give {id!r} a list of texts", (id,))
    return found
