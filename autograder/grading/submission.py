"""Grades submissions: runs each notebook in a sandbox, asks for the responses and marks them."""

from __future__ import annotations

import re
import time
import traceback
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import PurePath
from queue import SimpleQueue
from typing import Any

from autograder.course import Chapter, Course
from autograder.course.questions import Question
from autograder.errors import AutograderError
from autograder.exchange.replies import NOT_PLAIN
from autograder.intake.submissions import (
    Contents,
    Notebook,
    Submission,
    Unreadable,
    read_submission,
)
from autograder.kinds.registry import kind_of
from autograder.marking import Mark, not_attempted, stopped
from autograder.marking.marker import Marker
from autograder.marking.probe import Probe
from autograder.sandbox.launcher import Isolation, Sandbox, Session, Stopped


@dataclass(frozen=True)
class Graded:
    """The marks of one submission, in the order of the course's questions.

    ``status`` is ``graded`` or ``unreadable``; ``notes`` say what was odd about the files;
    ``seconds`` is how long running and marking took.
    """

    submission: Submission
    status: str
    fingerprint: str
    marks: tuple[Mark, ...]
    notes: tuple[str, ...] = ()
    seconds: float = 0.0

    @property
    def total(self) -> float:
        """The points earned."""
        return round(sum(mark.points for mark in self.marks), 2)


def grade_all(
    submissions: Sequence[Submission],
    marker: Marker,
    jobs: int,
    done: Callable[[Graded], None],
    questions: frozenset[str] | None = None,
    known: Callable[[str, str], Graded | None] | None = None,
    isolation: Isolation = "auto",
) -> None:
    """Grade submissions on up to ``jobs`` sandboxes at once; call ``done`` with each that is ready.

    ``done`` is called on the calling thread, and so is ``known``, which returns what the work of a
    student with some fingerprint was graded before: it is not run again. Only ``questions`` are
    marked, if they are given. ``isolation`` is as for `Sandbox`.

    Raises:
        SandboxError: if student code cannot be kept in here.
    """
    # In this order: leaving early ends the sandboxes first, so that no task goes on waiting.
    with ThreadPoolExecutor(jobs) as pool, ExitStack() as stack:
        slots = _Slots(marker, jobs, isolation, stack)

        def grade(submission: Submission, contents: Contents) -> Graded:
            slot = slots.idle.get()
            began = time.monotonic()
            fingerprint, notes = contents.fingerprint, tuple(contents.notes)
            try:
                marks = grade_contents(contents, marker, slot, questions)
            except AutograderError:
                raise  # the course or this machine, not the submission
            except Exception as error:
                # No submission, whatever it did, may keep the others from being graded. Without a
                # fingerprint it is not taken for graded, and the next run tries again.
                said = _grader_failed(error)
                marks = _all_marks(marker.course, "killed", said, questions)
                fingerprint, notes = "", (*notes, said)
            finally:
                slots.idle.put(slot)
            seconds = time.monotonic() - began
            return Graded(submission, "graded", fingerprint, tuple(marks), notes, seconds)

        def report(graded: Graded) -> None:
            done(graded)
            slots.grow(graded.seconds, waiting)

        names = [chapter.name for chapter in marker.course.chapters]
        tasks: set[Future[Graded]] = set()
        waiting = len(submissions)
        try:
            for submission in submissions:
                waiting -= 1
                try:
                    contents = read_submission(submission, marker.course.settings, names)
                except Unreadable as unreadable:
                    done(_unreadable(submission, marker.course, str(unreadable), questions))
                    continue
                except AutograderError:
                    raise
                except Exception as error:
                    failed = _grader_failed(error)
                    done(_unreadable(submission, marker.course, failed, questions))
                    continue
                before = known(submission.student, contents.fingerprint) if known else None
                if before is not None:
                    done(before)
                    continue
                if slots.count == 0:  # only now is there something to run
                    ready = pool.submit(marker.prepare, questions)
                    slots.add()
                    ready.result()
                tasks.add(pool.submit(grade, submission, contents))
                if len(tasks) > 2 * slots.count:  # so that memory does not grow with the class
                    tasks = _report_finished(tasks, report)
            while tasks:
                tasks = _report_finished(tasks, report)
        except BaseException:
            for task in tasks:
                task.cancel()
            raise


class _Slots:
    """The sandboxes of a run: one at first, and another whenever it saves more than it costs."""

    def __init__(self, marker: Marker, most: int, isolation: Isolation, until: ExitStack) -> None:
        self._marker, self._most, self._isolation, self._until = marker, most, isolation, until
        self._graded, self._seconds = 0, 0.0
        self.idle: SimpleQueue[Sandbox] = SimpleQueue()
        self.count = 0

    def add(self) -> None:
        """Open one more."""
        sandbox = Sandbox(self._marker.course, self._isolation, self._marker.seed)
        self.idle.put(self._until.enter_context(sandbox))
        self._start_seconds = sandbox.start_seconds
        self.count += 1

    def grow(self, seconds: float, waiting: int) -> None:
        """Open more if the submissions that wait are, at the pace so far, worth it.

        ``seconds`` is what the last submission took.
        """
        self._graded += 1
        self._seconds += seconds
        each = self._seconds / self._graded
        while self.count < self._most:
            saved = waiting * each / (self.count * (self.count + 1))
            if saved < self._start_seconds:
                return
            self.add()


def _report_finished(
    tasks: set[Future[Graded]], done: Callable[[Graded], None]
) -> set[Future[Graded]]:
    """Wait for a task to finish, report all that have, and return the others."""
    finished, running = wait(tasks, return_when=FIRST_COMPLETED)
    for task in finished:
        done(task.result())
    return running


def _unreadable(
    submission: Submission, course: Course, reason: str, questions: frozenset[str] | None
) -> Graded:
    marks = _all_marks(course, "unreadable", reason, questions)
    return Graded(submission, "unreadable", "", tuple(marks), (reason,))


def _all_marks(
    course: Course, status: str, reason: str, questions: frozenset[str] | None
) -> list[Mark]:
    """The same status for every question that is asked for."""
    return [
        stopped(question, status, reason)
        for question in course.questions.values()
        if questions is None or question.id in questions
    ]


def _grader_failed(error: Exception) -> str:
    """A sentence on an error of the autograder's own, without its text: that may be a student's."""
    place = traceback.extract_tb(error.__traceback__)[-1]
    return (
        f"The autograder itself failed on this submission ({type(error).__name__} in "
        f"{PurePath(place.filename).name}, line {place.lineno}); the points say nothing about the "
        "work. Mark it by hand, and report the failure."
    )


def grade_contents(
    contents: Contents,
    marker: Marker,
    sandbox: Sandbox,
    questions: frozenset[str] | None = None,
) -> list[Mark]:
    """Mark the notebooks of one student, in the order of the course's questions."""
    contents = _by_chapter(contents, marker.course)
    deadline = time.monotonic() + marker.course.settings.submission_seconds
    return [
        mark
        for chapter in marker.course.chapters
        for mark in _grade_chapter(
            chapter,
            [q for q in chapter.questions if questions is None or q.id in questions],
            contents,
            marker,
            sandbox,
            deadline,
        )
    ]


def _by_chapter(contents: Contents, course: Course) -> Contents:
    """The contents with every notebook under a chapter of the course.

    A notebook whose name says nothing (``jacobi.ipynb``) is recognised by the questions it asks.
    """
    known = {chapter.name for chapter in course.chapters}
    notebooks = {name: book for name, book in contents.notebooks.items() if name in known}
    for name, notebook in contents.notebooks.items():
        code = "\n".join(notebook.cells)
        asked = {
            chapter.name: sum(f'"{question.id}"' in code for question in chapter.questions)
            for chapter in course.chapters
            if chapter.name not in notebooks
        }
        likeliest = max(asked, key=lambda chapter: asked[chapter], default=None)
        if name not in known and likeliest is not None and asked[likeliest] > 0:
            notebooks[likeliest] = notebook
    return replace(contents, notebooks=notebooks)


def _grade_chapter(
    chapter: Chapter,
    asked: list[Question],
    contents: Contents,
    marker: Marker,
    sandbox: Sandbox,
    deadline: float,
) -> list[Mark]:
    if not asked:
        return []
    notebook = contents.notebooks.get(chapter.name, Notebook(cells=[], receipts={}))
    cells = [cell for cell in notebook.cells if cell not in marker.course.demo_cells]
    given = {
        id: entry["response"]
        for id, entry in contents.sidecars.get(chapter.name, {}).items()
        if entry.get("response") is not None
    }
    # What was typed into a field counts where the notebook itself assigns nothing.
    kept = {**notebook.receipts, **given}
    fillings = {q.id: kind_of(q).typed_cell(q, kept.get(q.id)) for q in asked}
    typed = {id: cell for id, cell in fillings.items() if cell is not None}
    cells += typed.values()
    with sandbox.session(deadline) as session:
        names = [question.name for question in asked if question.name]
        report: dict[str, Any] = {}
        failure: Stopped | None = None
        try:
            if cells:
                report = session.run(cells, names)
        except Stopped as stop:
            failure = stop
        # What the student's widgets wrote is the truth; the code's own `respond` and the receipts
        # in the outputs stand in where it is missing.
        responses = {**notebook.receipts, **_dictionary(report.get("responses")), **given}
        understood = _dictionary(report.get("understood"))

        def mark_without_asking(question: Question) -> Mark | None:
            is_choice = question.name is None
            choice = responses.get(question.id) if is_choice else None
            if choice is not None:
                return marker.mark(question.id, choice)
            if chapter.name in contents.unreadable:
                return stopped(question, "unreadable", contents.unreadable[chapter.name])
            if chapter.name not in contents.notebooks and question.id not in typed:
                return not_attempted(question, "Its notebook was not handed in.")
            if failure is not None:
                return stopped(question, failure.status, _notebook_stopped(failure))
            return not_attempted(question) if is_choice else None

        marks = {question.id: mark_without_asking(question) for question in asked}
        to_ask = [question for question in asked if marks[question.id] is None]
        # Of all questions before the rest of any: what one function is asked with can be kept in a
        # file for another.
        openings = {q.id: _open(q, session, marker) for q in to_ask}
        for question in to_ask:
            said = _line(understood.get(question.name or "", ""))
            opening = openings[question.id]
            marks[question.id] = _mark_named(
                question, session, marker, cells, report, said, opening
            )
        return [mark for mark in marks.values() if mark is not None]


def _notebook_stopped(stop: Stopped) -> str:
    if stop.status == "timeout":
        why = f": {stop.why}" if stop.why else ""
        return f"Running the notebook took longer than the time limit{why}."
    why = stop.why or "too much memory, a crash, or an exit"
    return f"The notebook's process ended while it ran: {why}."


def _response_stopped(stop: Stopped) -> str:
    if stop.status == "timeout" and stop.why:
        return f"It took longer than the time limit: {stop.why}."
    return f"The process that ran it was ended: {stop.why}." if stop.why else ""


def _open(question: Question, session: Session, marker: Marker) -> dict[str, Any] | Stopped | None:
    """What came back for the question's opening; None if it has none."""
    sent = marker.probe(question.id).opening
    if sent is None or question.name is None:
        return None
    try:
        return session.evaluate(question.name, sent)
    except Stopped as stop:
        return stop


def _ask(
    name: str, session: Session, probe: Probe, opening: dict[str, Any] | Stopped | None
) -> dict[str, Any]:
    """What comes back for the whole probe, of which the opening was put before.

    Raises:
        Stopped: if either part was stopped.
    """
    if isinstance(opening, Stopped):
        raise opening
    if opening is not None and opening.get("state") != "given":
        return opening
    if opening is not None and not probe.rest["cases"]:
        return opening
    response = session.evaluate(name, probe.rest)
    if opening is None or response.get("state") != "given":
        return response
    first, others = opening.get("outcomes"), response.get("outcomes")
    if not (isinstance(first, list) and isinstance(others, list) and len(first) == 1):
        # With any other number an outcome of the rest would pass for that of the opening.
        return NOT_PLAIN
    return {"state": "given", "outcomes": first + others}


def _mark_named(
    question: Question,
    session: Session,
    marker: Marker,
    cells: list[str],
    report: dict[str, Any],
    understood: str,
    opening: dict[str, Any] | Stopped | None,
) -> Mark:
    """Mark a response that a variable or a function of the notebook holds."""
    assert question.name is not None
    try:
        response = _ask(question.name, session, marker.probe(question.id), opening)
    except Stopped as stop:
        return stopped(question, stop.status, _response_stopped(stop))
    reason = response.get("reason")
    missing = isinstance(reason, str) and reason == "missing"
    if missing and _defining_cell_failed(question.name, cells, report):
        return stopped(
            question,
            "error",
            f"The cell that should define {question.name} raised an exception. "
            "Restart the kernel, run all cells, and mend the first one that fails.",
        )
    return marker.mark(question.id, response, understood)


def _defining_cell_failed(name: str, cells: list[str], report: dict[str, Any]) -> bool:
    # No \s: it takes line ends too, and a cell of empty lines would then be searched from each of
    # them to the end, for minutes and with every other thread waiting.
    name = re.escape(name)
    defines = re.compile(rf"^[ \t]*(def[ \t]+{name}\b|{name}[ \t]*(:[^=\n]*)?=[^=])", re.MULTILINE)
    errors = report.get("errors")
    if not isinstance(errors, list):
        return False
    return any(
        error is not None and defines.search(cell)
        for cell, error in zip(cells, errors, strict=False)
    )


def _line(value: Any) -> str:
    """One short printable line of what a student's process said; it may have said anything."""
    text = value if isinstance(value, str) else ""
    return "".join(c if c.isprintable() else " " for c in text[:200])


def _dictionary(value: Any) -> dict[str, Any]:
    return value if isinstance(value, dict) else {}
