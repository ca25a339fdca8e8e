"""Grades a class: reads one submission after the other and has each graded, wherever that is."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence

from autograder.course import Course
from autograder.errors import AutograderError, machine_error
from autograder.grading.graded import Graded, grader_failed, same_mark_for_all, unreadable
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
    known: Callable[[str, str], Graded | None] | None = None,
    watch: Watch | None = None,
    works: Mapping[str, Sequence[str]] | None = None,
) -> None:
    """Grade submissions on ``spread``; call ``done`` with each as soon as it is ready.

    ``done`` is called on the calling thread, and so is ``known``, which returns what the work of a
    student with some fingerprint was graded before: it is not run again. Only ``questions`` are
    marked, if they are given. ``works`` are the fingerprints of what each student handed in until
    now: other work is marked with other hidden inputs.

    What may have been this machine's doing, and what was at work when an earlier run died, is
    graded last and alone. What the grader died of is passed by.

    Raises:
        AutograderError: if the course or a machine is broken. What was graded until then was
            given to ``done``.
    """
    run = _Run(course, spread, done, questions, known, watch, works or {})
    deaths = {entry.student: watch.deaths(entry) if watch else 0 for entry in submissions}
    together = [entry for entry in submissions if not deaths[entry.student]]
    for count, submission in enumerate(together, 1):
        run.begin(submission, more=len(together) - count)
        run.take_finished(wait=not spread.has_room)
    run.take_all()
    for submission in run.doubtful:
        run.begin(submission, more=0, again=True)
        run.take_all()
    for submission in submissions:
        if deaths[submission.student] >= PASSED_BY:
            done(_passed_by(submission, course, questions))
        elif deaths[submission.student]:
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
        known: Callable[[str, str], Graded | None] | None,
        watch: Watch | None,
        works: Mapping[str, Sequence[str]],
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
            before = self._known(submission.student, fingerprint) if self._known else None
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
            works = self._works.get(submission.student, ())
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
