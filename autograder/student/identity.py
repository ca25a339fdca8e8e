"""Who the student is: said once, kept with the responses, and the reason for their numbers."""

from __future__ import annotations

from autograder.course import Course
from autograder.errors import UsageError
from autograder.exchange.identity import FILE, clean, said_to_be
from autograder.language import _
from autograder.questions.variables import canonical
from autograder.student.responses import Responses, responses_folder


def student_of(course: Course) -> str:
    """The name or number that was given before; empty if none."""
    return said_to_be({FILE: _file(course).all()})


def warning(course: Course, name: object) -> str:
    """What a change of name would mean, for the student to confirm; empty if nothing changes.

    Raises:
        UsageError: if it is not a name.
    """
    new, before = _read(name), student_of(course)
    if not before or canonical(before) == canonical(new):
        return ""
    if not course.personal:
        sentence = _("You have been {name} so far. Your answers stay as they are.")
        return sentence.format(name=before)
    sentence = _(
        "You have been {name} so far. With another name your questions have other numbers, and "
        "what you have answered counts for the new ones."
    )
    return sentence.format(name=before)


def _read(name: object) -> str:
    if not isinstance(name, str | int) or isinstance(name, bool) or not clean(str(name)):
        sentence = _("Say who you are as your class list does, such as {call}.")
        raise UsageError(sentence.format(call='me("Ada Lovelace")'))
    return clean(str(name))


def become(course: Course, name: object) -> str:
    """Keep who the student is; returns what to tell them.

    Raises:
        UsageError: if it is not a name.
        ResponsesError: if it cannot be saved.
    """
    new, before = _read(name), student_of(course)
    _file(course).update(FILE, lambda entry: {**entry, "response": new})
    if not course.personal:
        sentence = _("You are {name}. Everybody has the same numbers in this course.")
        return sentence.format(name=new)
    if before and canonical(before) != canonical(new):
        sentence = _(
            "You are {name} from now on, not {before}: your questions have other numbers. What you "
            "answered before belongs to {before}'s numbers; answer it again, or go back with "
            "{call}."
        )
        return sentence.format(name=new, before=before, call=f"me({before!r})")
    sentence = _(
        "You are {name}. The numbers in your questions are yours: run the cells below again."
    )
    return sentence.format(name=new)


def _file(course: Course) -> Responses:
    return Responses(responses_folder(course.root), FILE)
