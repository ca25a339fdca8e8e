"""Grades a class: reads one submission after the other and has each graded, wherever that is."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence

from autograder.course import Course
from autograder.errors import AutograderError, machine_error
from autograder.grading.graded import Graded, grader_failed, unreadable
from autograder.grading.spread import Spread, Task
from autograder.intake.handout import Handout, handout_of
from autograder.intake.submissions import Submission, Unreadable, read_submission


def grade_class(
    submissions: Sequence[Submission],
    course: Course,
    spread: Spread,
    done: Callable[[Graded], None],
    questions: Collection[str] | None = None,
    known: Callable[[str, str], Graded | None] | None = None,
) -> None:
    """Grade submissions on ``spread``; call ``done`` with each as soon as it is ready.

    ``done`` is called on the calling thread, and so is ``known``, which returns what the work of a
    student with some fingerprint was graded before: it is not run again. Only ``questions`` are
    marked, if they are given.

    Raises:
        AutograderError: if the course or a machine is broken. What was graded until then was
            given to ``done``.
    """
    more = len(submissions)
    handout = handout_of(course)
    for submission in submissions:
        more -= 1
        read = _read(submission, course, handout, questions)
        if isinstance(read, Graded):
            done(read)
            continue
        before = known(submission.student, read.contents.fingerprint) if known else None
        if before is not None:
            done(before)
            continue
        spread.begin(read, more)
        for graded in spread.finished(wait=not spread.has_room):
            done(graded)
    while spread.under_way:
        for graded in spread.finished(wait=True):
            done(graded)


def _read(
    submission: Submission,
    course: Course,
    handout: Handout,
    questions: Collection[str] | None,
) -> Task | Graded:
    """What is to be graded, or what is said of a submission that cannot be read."""
    try:
        return Task(submission, read_submission(submission, course.settings, handout))
    except Unreadable as reason:
        return unreadable(submission, course, str(reason), questions)
    except AutograderError:
        raise
    except Exception as error:
        short = machine_error(error)
        if short is not None:
            raise short from None
        return unreadable(submission, course, grader_failed(error), questions)
