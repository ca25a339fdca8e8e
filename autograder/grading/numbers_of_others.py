"""Whether work was done with the numbers of the student who handed it in."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from autograder.course import Course
from autograder.grading.graded_submission import Graded
from autograder.intake.person import Person
from autograder.language import N_, _
from autograder.questions.variables import canonical

NOT_THEIRS = N_("This was done with the numbers of somebody else, which counts for nothing here.")


def compare_numbers(graded: Graded, course: Course, people: Iterable[Person]) -> Graded:
    """The same, with a note where the numbers are those of somebody else, or of nobody.

    ``people`` are those of the class list whom the work belongs to. Its marks stay, or are nothing
    for the questions that have variants, as the course says.
    """
    if not course.personal or graded.status != "graded":
        return graded
    people = list(people)
    if not graded.numbers_of:
        sentence = _(
            "It does not say who it is from, so it was marked with the numbers of the sheet."
        )
        return replace(graded, notes=(*graded.notes, sentence))
    if not people or canonical(graded.numbers_of) in _names(graded, people):
        return graded
    sentence = _("It was done and marked with the numbers of {name}, not with their own.")
    sentence = sentence.format(name=repr(graded.numbers_of))
    marks = graded.marks
    if not course.others_count:
        marks = tuple(
            replace(mark, status="wrong", credit=0.0, feedback=_(NOT_THEIRS))
            if mark.question in course.varied and mark.credit
            else mark
            for mark in marks
        )
    return replace(graded, marks=marks, notes=(*graded.notes, sentence))


def _names(graded: Graded, people: Iterable[Person]) -> set[str]:
    """Everything that a student may call themselves."""
    names = {graded.submission.student}
    for person in people:
        names.update(person.names_said())
    return {canonical(name) for name in names if name.strip()}
