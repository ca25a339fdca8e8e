"""Grades submissions: runs each notebook in a sandbox, asks for the responses and marks them."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from dataclasses import dataclass
from queue import SimpleQueue
from typing import Any

from autograder.course import Chapter, Course
from autograder.marker import Marker
from autograder.marking import Mark, not_attempted, stopped
from autograder.questions import Order, Question, TrueFalse
from autograder.sandbox.launcher import Sandbox, Session, Stopped
from autograder.submissions import Contents, Notebook, Submission, Unreadable, read_submission


@dataclass(frozen=True)
class Graded:
    """The marks of one submission, in the order of the course's questions.

    ``status`` is ``graded`` or ``unreadable``; ``notes`` say what was odd about the files.
    """

    submission: Submission
    status: str
    fingerprint: str
    marks: tuple[Mark, ...]
    notes: tuple[str, ...] = ()

    @property
    def total(self) -> float:
        """The points earned."""
        return round(sum(mark.points for mark in self.marks), 2)


def grade_all(
    submissions: Iterable[Submission],
    marker: Marker,
    jobs: int,
    done: Callable[[Graded], None],
    sandbox: Callable[[Course], Sandbox] = Sandbox,
    questions: frozenset[str] | None = None,
) -> None:
    """Grade submissions on ``jobs`` sandboxes at once and call ``done`` with each, as it is ready.

    ``done`` is called on the calling thread. Only ``questions`` are marked, if they are given.
    """
    with ExitStack() as stack:
        idle: SimpleQueue[Sandbox] = SimpleQueue()
        for _ in range(jobs):
            # On this thread: a sandbox ends with the thread that started it.
            idle.put(stack.enter_context(sandbox(marker.course)))
        pool = stack.enter_context(ThreadPoolExecutor(jobs))
        finished: SimpleQueue[Graded | BaseException] = SimpleQueue()

        def grade(submission: Submission) -> None:
            slot = idle.get()
            try:
                finished.put(grade_submission(submission, marker, slot, questions))
            except BaseException as error:
                finished.put(error)
            finally:
                idle.put(slot)

        tasks = [pool.submit(grade, submission) for submission in submissions]
        try:
            for _ in tasks:
                result = finished.get()
                if isinstance(result, BaseException):
                    raise result
                done(result)
        finally:
            for task in tasks:
                task.cancel()


def grade_submission(
    submission: Submission,
    marker: Marker,
    sandbox: Sandbox,
    questions: frozenset[str] | None = None,
) -> Graded:
    """Grade one submission. Whatever is in it, this returns marks and raises nothing."""
    course = marker.course
    asked = [q for q in course.questions.values() if questions is None or q.id in questions]
    try:
        contents = read_submission(submission, course.settings)
    except Unreadable as unreadable:
        marks = tuple(stopped(question, "unreadable", str(unreadable)) for question in asked)
        return Graded(submission, "unreadable", "", marks, (str(unreadable),))
    marks = tuple(
        mark
        for chapter in course.chapters
        for mark in _grade_chapter(
            chapter, [q for q in chapter.questions if q in asked], contents, marker, sandbox
        )
    )
    return Graded(submission, "graded", contents.fingerprint, marks, tuple(contents.notes))


def _grade_chapter(
    chapter: Chapter,
    asked: list[Question],
    contents: Contents,
    marker: Marker,
    sandbox: Sandbox,
) -> list[Mark]:
    if not asked:
        return []
    notebook = contents.notebooks.get(chapter.name, Notebook(cells=[], receipts={}))
    given = {
        id: entry.get("response") for id, entry in contents.sidecars.get(chapter.name, {}).items()
    }
    with sandbox.session() as session:
        names = [question.name for question in asked if question.name]
        report: dict[str, Any] = {}
        failure = None
        try:
            if notebook.cells:
                report = session.run(notebook.cells, names)
        except Stopped as stop:
            failure = stop.status
        # What the student's widgets wrote is the truth; the code's own `respond` and the receipts
        # in the outputs stand in where it is missing.
        responses = {**notebook.receipts, **_dictionary(report.get("responses")), **given}
        understood = _dictionary(report.get("understood"))
        marks = []
        for question in asked:
            if isinstance(question, TrueFalse | Order):
                marks.append(marker.mark(question.id, responses.get(question.id)))
            elif chapter.name not in contents.notebooks:
                marks.append(not_attempted(question, "Its notebook was not handed in."))
            elif failure is not None:
                marks.append(stopped(question, failure, _NOTEBOOK_STOPPED[failure]))
            else:
                said = str(understood.get(question.name, ""))
                marks.append(_mark_named(question, session, marker, notebook, report, said))
        return marks


_NOTEBOOK_STOPPED = {
    "timeout": "Running the notebook took longer than the time limit.",
    "killed": "The notebook's process ended while it ran: too much memory, a crash, or an exit.",
}


def _mark_named(
    question: Question,
    session: Session,
    marker: Marker,
    notebook: Notebook,
    report: dict[str, Any],
    understood: str,
) -> Mark:
    """Mark a response that a variable or a function of the notebook holds."""
    assert question.name is not None
    try:
        response = session.evaluate(question.name, marker.probe(question.id).sent)
    except Stopped as stop:
        return stopped(question, stop.status)
    if response.get("reason") == "missing" and _defining_cell_failed(
        question.name, notebook, report
    ):
        return stopped(
            question,
            "error",
            f"The cell that should define {question.name} raised an exception. "
            "Restart the kernel, run all cells, and mend the first one that fails.",
        )
    return marker.mark(question.id, response, understood)


def _defining_cell_failed(name: str, notebook: Notebook, report: dict[str, Any]) -> bool:
    defines = re.compile(rf"^\s*(def\s+{name}\b|{name}\s*(:[^=\n]*)?=[^=])", re.MULTILINE)
    errors = report.get("errors")
    if not isinstance(errors, list):
        return False
    return any(
        error is not None and defines.search(cell)
        for cell, error in zip(notebook.cells, errors, strict=False)
    )


def _dictionary(value: Any) -> dict[str, Any]:
    return value if isinstance(value, dict) else {}
