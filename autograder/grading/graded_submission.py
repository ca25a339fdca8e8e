"""What comes out of grading one submission, whoever did it and wherever."""

from __future__ import annotations

import traceback
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from pathlib import PurePath

from autograder.course import Course
from autograder.course.predictions import Guess
from autograder.intake.submissions import Submission
from autograder.marking import Mark, stopped


@dataclass(frozen=True)
class Graded:
    """The marks of one submission, in the order of the course's questions.

    ``status`` is ``graded`` or ``unreadable``; ``notes`` say what was odd about the files;
    ``seconds`` is how long running and marking took. What is doubtful was stopped by something that
    neither its own time nor its own memory explains, as on a machine that has too much to do.
    """

    submission: Submission
    status: str
    fingerprint: str
    marks: tuple[Mark, ...]
    notes: tuple[str, ...] = ()
    seconds: float = 0.0
    is_doubtful: bool = False
    numbers_of: str = ""  # who the work says it is from, where each student has their own numbers
    predictions: Mapping[str, Guess] = field(default_factory=dict)  # by id, as the course has them
    isolation: str = ""  # what kept its code in, where it ran

    @property
    def total(self) -> float:
        """The points earned."""
        return round(sum(mark.points for mark in self.marks), 2)


def unreadable(
    submission: Submission, course: Course, reason: str, questions: Collection[str] | None
) -> Graded:
    """A submission of which nothing can be read."""
    marks = same_mark_for_all(course, "unreadable", reason, questions)
    return Graded(submission, "unreadable", "", marks, (reason,))


def same_mark_for_all(
    course: Course, status: str, reason: str, questions: Collection[str] | None
) -> tuple[Mark, ...]:
    """The same status and reason for every question that is asked for (None: for all)."""
    return tuple(
        stopped(question, status, reason)
        for question in course.questions.values()
        if questions is None or question.id in questions
    )


def grader_failed(error: Exception) -> str:
    """A sentence on an error of the autograder's own, without its text: that may be a student's."""
    place = traceback.extract_tb(error.__traceback__)[-1]
    return (
        f"The autograder itself failed on this submission ({type(error).__name__} in "
        f"{PurePath(place.filename).name}, line {place.lineno}); the points say nothing about the "
        "work. Mark it by hand, and report the failure."
    )
