"""How one chapter of a submission is graded: its notebook runs once, then each question is put.

`grade_chapter` is the whole way; what follows are its steps, in this order.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from autograder.course import Chapter
from autograder.course.questions import Question
from autograder.exchange.exception_text import in_words
from autograder.exchange.messages import Evaluation, Message, Told
from autograder.exchange.replies import NOT_PLAIN
from autograder.grading.collected_work import Work, collect_work
from autograder.grading.own_exceptions import defining_cell, import_notes
from autograder.grading.stop_sentences import notebook_stopped, response_stopped
from autograder.grading.visible_example import ask_about_the_example, with_code
from autograder.intake.submissions import Contents
from autograder.language import _
from autograder.marking import Mark, not_attempted, stopped
from autograder.marking.marker import Marker
from autograder.questions.drawn import Drawn
from autograder.sandbox.launcher import Sandbox, Session, Stopped

Opening = Evaluation | Stopped | None
_SAY_WHO = "__import__('autograder').me({!r})"  # what the student said in another notebook


def grade_chapter(
    chapter: Chapter,
    asked: Sequence[Question],
    contents: Contents,
    marker: Marker,
    sandbox: Sandbox,
    deadline: float,
    student: str = "",
) -> list[Mark]:
    """Mark the questions ``asked`` of one chapter; ``deadline`` is on the monotonic clock.

    ``student`` is whose numbers the notebook finds, where everybody has their own.
    """
    if not asked:
        return []
    work = collect_work(chapter, asked, contents, marker.course)
    if student and work.cells:
        work = replace(work, cells=[_SAY_WHO.format(student), *work.cells])
    with sandbox.session(deadline) as session:
        ran = _run_notebook(work, asked, session)
        marks = {q.id: _mark_without_asking(q, work, ran, marker) for q in asked}
        to_ask = [question for question in asked if marks[question.id] is None]
        # Of all questions before the rest of any: what one function is asked with can be kept in a
        # file for another.
        openings = {q.id: _open(q, session, marker) for q in to_ask}
        for question in to_ask:
            opening = openings[question.id]
            marks[question.id] = _mark_named(question, session, marker, work, ran, opening)
    contents.notes.extend(import_notes(chapter.title, ran.told))
    found = [mark for mark in marks.values() if mark is not None]
    said = ask_about_the_example(found, work, marker, sandbox, deadline)
    return [with_code(mark, marker.course.questions[mark.question], work, said) for mark in found]


@dataclass(frozen=True)
class _Ran:
    """What a student's process said when it had run the cells, of any shape, or why it did not."""

    responses: dict[str, object] = field(default_factory=dict)
    understood: dict[str, object] = field(default_factory=dict)
    errors: list[str | None] = field(default_factory=list)
    told: list[Told | None] = field(default_factory=list)
    failure: Stopped | None = None


def _run_notebook(work: Work, asked: Sequence[Question], session: Session) -> _Ran:
    if not work.cells:
        return _Ran()
    try:
        report = session.run(work.cells, [question.name for question in asked if question.name])
    except Stopped as stop:
        return _Ran(failure=stop)
    # Once more of any shape: this is where points come from.
    told, errors = report.get("told"), report.get("errors")
    return _Ran(
        _dictionary(report.get("responses")),
        _dictionary(report.get("understood")),
        errors if isinstance(errors, list) else [],
        told if isinstance(told, list) else [],
    )


def _mark_without_asking(question: Question, work: Work, ran: _Ran, marker: Marker) -> Mark | None:
    """The mark of a choice, or of what cannot be asked; None where the process must be asked."""
    is_choice = question.name is None
    if is_choice:
        # What the student's widgets wrote is the truth; the code's own `respond` and the receipts
        # in the outputs stand in where it is missing.
        choice = {**work.receipts, **ran.responses, **work.given}.get(question.id)
        if choice is not None:
            return marker.mark(question.id, choice)
    if work.unreadable is not None:
        return stopped(question, "unreadable", work.unreadable)
    if work.is_missing and question.id not in work.typed:
        return not_attempted(question, _("Its notebook was not handed in."))
    if ran.failure is not None:
        return stopped(question, ran.failure.status, notebook_stopped(ran.failure))
    return not_attempted(question) if is_choice else None


def _open(question: Question, session: Session, marker: Marker) -> Opening:
    """What came back for the question's opening; None if it has none."""
    probe = marker.drawn(question.id).opening
    if probe is None or question.name is None:
        return None
    try:
        return session.evaluate(question.name, probe)
    except Stopped as stop:
        return stop


def _mark_named(
    question: Question, session: Session, marker: Marker, work: Work, ran: _Ran, opening: Opening
) -> Mark:
    """Mark a response that a variable or a function of the notebook holds."""
    assert question.name is not None
    try:
        response = _ask(question.name, session, marker.drawn(question.id), opening)
    except Stopped as stop:
        return stopped(question, stop.status, response_stopped(stop))
    reason = response.get("reason")
    missing = isinstance(reason, str) and reason == "missing"
    defining = defining_cell(question.name, work.cells) if missing else None
    if defining is not None and isinstance(ran.errors, list) and any(ran.errors[defining:][:1]):
        mark = stopped(
            question,
            "error",
            _(
                "The cell that should define {name} raised an exception. "
                "Restart the kernel, run all cells, and fix the first one that fails."
            ).format(name=question.name),
        )
        return replace(mark, told=in_words(next(iter(ran.told[defining:]), None)))
    return marker.mark(question.id, response, _line(ran.understood.get(question.name, "")))


def _ask(name: str, session: Session, drawn: Drawn, opening: Opening) -> Evaluation:
    """What comes back for the whole probe, of which the opening was put before.

    Raises:
        Stopped: if either part was stopped.
    """
    if isinstance(opening, Stopped):
        raise opening
    if opening is not None and opening.get("state") != "given":
        return opening
    if opening is not None and not drawn.rest["cases"]:
        return opening
    response = session.evaluate(name, drawn.rest)
    if opening is None or response.get("state") != "given":
        return response
    first, others = opening.get("outcomes"), response.get("outcomes")
    if not (isinstance(first, list) and isinstance(others, list) and len(first) == 1):
        # With any other number an outcome of the rest would pass for that of the opening.
        return NOT_PLAIN
    return {"state": "given", "outcomes": first + others}


def _line(value: object) -> str:
    """One short printable line of what a student's process said; it may have said anything."""
    text = value if isinstance(value, str) else ""
    return "".join(c if c.isprintable() else " " for c in text[:200])


def _dictionary(value: object) -> Message:
    return value if isinstance(value, dict) else {}
