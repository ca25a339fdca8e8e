"""Grades a class: reads one submission after the other and has each graded, wherever that is."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence

from autograder.course import Course
from autograder.errors import AutograderError, machine_error
from autograder.grading.graded_submission import (
    Graded,
    grader_failed,
    same_mark_for_all,
    unreadable,
)
from autograder.grading.journal import PASSED_BY, STOPPED_THE_GRADER, Watch
from autograder.grading.spread import Spread, Task
from autograder.intake.handout import handout_of
from autograder.intake.submissions import Submission, Unreadable, read_submission
from autograder.marking.draw import set_number


def grade_class(
    submissions: Sequence[Submission],
    course: Course,
    spread: Spread,
    done: Callable[[Graded], None],
    questions: Collection[str] | None = None,
    known: Callable[[Submission, str], Graded | None] | None = None,
    watch: Watch | None = None,
    works: Callable[[str], Sequence[str]] | None = None,
) -> None:
    """Grade submissions on ``spread``; call ``done`` with each as soon as it is ready.

    ``done`` is called on the calling thread, and so is ``known``, which returns what a submission
    with some fingerprint was graded before: it is not run again. Only ``questions`` are marked, if
    they are given. ``works`` says, there too, the fingerprints of what a student handed in until
    now: other work is marked with other hidden inputs. Nothing is kept of what was done.

    What may have been this machine's doing, and what was at work when an earlier run died, is
    graded last and alone. What the grader died of is passed by.

    Raises:
        AutograderError: if the course or a machine is broken. What was graded until then was
            given to ``done``.
    """
    run = _Run(course, spread, done, questions, known, watch, works)
    deadly: list[tuple[Submission, int]] = []
    for count, submission in enumerate(submissions, 1):
        if watch is not None and (deaths := watch.deaths(submission)):
            deadly.append((submission, deaths))
            continue
        run.begin(submission, more=len(submissions) - count)
        run.take_finished(wait=not spread.has_room)
    run.take_all()
    for submission in run.doubtful:
        run.begin(submission, more=0, again=True)
        run.take_all()
    for submission, deaths in deadly:
        if deaths >= PASSED_BY:
            done(_passed_by(submission, course, questions))
        else:
            run.begin(submission, more=0, again=True)
            run.take_all()


class _Run:
    """One run over a class, from one thread."""

    def __init__(
        self,
        course: Course,
        spread: Spread,
        done: Callable[[Graded], None],
        questions: Collection[str] | None,
        known: Callable[[Submission, str], Graded | None] | None,
        watch: Watch | None,
        works: Callable[[str], Sequence[str]] | None,
    ) -> None:
        self._course, self._spread, self._done = course, spread, done
        self._questions, self._known, self._watch = questions, known, watch
        self._works = works
        self._handout = handout_of(course)
        self._last_try: set[str] = set()
        self.doubtful: list[Submission] = []

    def begin(self, submission: Submission, more: int, again: bool = False) -> None:
        """Read a submission and have it graded, unless that was done before.

        With ``again``, its marks count whatever stopped it.
        """
        if again:
            self._last_try.add(submission.student)
        if self._watch is not None:
            self._watch.begin(submission)
        read = self._read(submission)
        if isinstance(read, Task):
            fingerprint = read.contents.fingerprint
            before = self._known(submission, fingerprint) if self._known else None
            if before is None:
                self._spread.begin(read, more)
                return
            read = before
        self._finish(read)

    def take_finished(self, wait: bool) -> None:
        """Take what was graded; if ``wait``, at least one if any is under way."""
        for graded in self._spread.finished(wait):
            self._finish(graded)

    def take_all(self) -> None:
        """Take everything that is under way."""
        while self._spread.under_way:
            self.take_finished(wait=True)

    def _finish(self, graded: Graded) -> None:
        submission = graded.submission
        if graded.is_doubtful and submission.student not in self._last_try:
            self.doubtful.append(submission)
        else:
            self._done(graded)
        if self._watch is not None:
            self._watch.end(submission)

    def _read(self, submission: Submission) -> Task | Graded:
        """What is to be graded, or what is said of a submission that cannot be read."""
        course, questions = self._course, self._questions
        try:
            contents = read_submission(submission, course.settings, self._handout)
            works = self._works(submission.student) if self._works else ()
            return Task(
                submission, contents, set_number(submission.student, contents.fingerprint, works)
            )
        except Unreadable as reason:
            return unreadable(submission, course, str(reason), questions)
        except AutograderError:
            raise
        except Exception as error:
            short = machine_error(error)
            if short is not None:
                raise short from None
            return unreadable(submission, course, grader_failed(error), questions)


def _passed_by(submission: Submission, course: Course, questions: Collection[str] | None) -> Graded:
    """Of a submission that stopped the grader; without a fingerprint it is not taken for graded."""
    marks = same_mark_for_all(course, "killed", STOPPED_THE_GRADER, questions)
    return Graded(submission, "graded", "", marks, (STOPPED_THE_GRADER,))
