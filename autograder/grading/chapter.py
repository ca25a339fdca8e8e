"""How one chapter of a submission is graded: its notebook runs once, then each question is put.

`grade_chapter` is the whole way; what follows are its steps, in this order.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from autograder.course import Chapter, Course
from autograder.course.questions import Question
from autograder.exchange.exception_text import in_words
from autograder.exchange.messages import Evaluation, Message, Outcome, Told
from autograder.exchange.replies import NOT_PLAIN
from autograder.exchange.why_unusable import REASONS
from autograder.grading.own_exceptions import defining_cell, import_notes, shown_code
from autograder.grading.stop_sentences import notebook_stopped, response_stopped
from autograder.intake.submissions import Contents
from autograder.language import _
from autograder.marking import Mark, not_attempted, stopped
from autograder.marking.marker import Marker
from autograder.questions.drawn import Drawn
from autograder.questions.mark import NO_VALUE
from autograder.questions.registry import kind_of
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
    work = _collect(chapter, asked, contents, marker.course)
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
    said = _ask_about_the_example(found, work, marker, sandbox, deadline)
    return [_with_code(mark, marker.course.questions[mark.question], work, said) for mark in found]


@dataclass(frozen=True)
class _Work:
    """What a student handed in for one chapter.

    ``cells`` are run; ``given`` are saved responses and ``receipts`` those in the outputs, both by
    question. ``typed`` are questions whose field was filled in. ``unreadable`` says why the
    notebook could not be opened, and ``is_missing`` that there is none.
    """

    cells: list[str]
    receipts: dict[str, object]
    given: dict[str, object]
    typed: frozenset[str]
    unreadable: str | None
    is_missing: bool


def _collect(
    chapter: Chapter, asked: Sequence[Question], contents: Contents, course: Course
) -> _Work:
    notebook = contents.notebooks.get(chapter.name)
    receipts = notebook.receipts if notebook else {}
    given = {
        id: entry["response"]
        for id, entry in contents.sidecars.get(chapter.name, {}).items()
        if entry.get("response") is not None
    }
    # What was typed into a field counts where the notebook itself assigns nothing.
    kept = {**receipts, **given}
    fillings = {q.id: kind_of(q).typed_cell(q, kept.get(q.id)) for q in asked}
    typed = {id: cell for id, cell in fillings.items() if cell is not None}
    cells = [cell for cell in (notebook.cells if notebook else ()) if cell not in course.demo_cells]
    return _Work(
        [*cells, *typed.values()],
        receipts,
        given,
        frozenset(typed),
        contents.unreadable.get(chapter.name),
        notebook is None,
    )


@dataclass(frozen=True)
class _Ran:
    """What a student's process said when it had run the cells, of any shape, or why it did not."""

    responses: dict[str, object] = field(default_factory=dict)
    understood: dict[str, object] = field(default_factory=dict)
    errors: list[str | None] = field(default_factory=list)
    told: list[Told | None] = field(default_factory=list)
    failure: Stopped | None = None


def _run_notebook(work: _Work, asked: Sequence[Question], session: Session) -> _Ran:
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


def _mark_without_asking(question: Question, work: _Work, ran: _Ran, marker: Marker) -> Mark | None:
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
    question: Question, session: Session, marker: Marker, work: _Work, ran: _Ran, opening: Opening
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


@dataclass(frozen=True)
class _Example:
    """What a function does with the input that students may see: raises, or gives no value."""

    told: str = ""
    reason: str = ""


def _ask_about_the_example(
    marks: Sequence[Mark], work: _Work, marker: Marker, sandbox: Sandbox, deadline: float
) -> dict[str, _Example]:
    """What functions do with the inputs that students may see, in a process of its own.

    The process that was marked knows the hidden inputs by now; what it says could carry them. Only
    what gave no value for some input is asked again.
    """
    asked = [
        (question, opening)
        for mark in marks
        if not mark.told
        and (_(NO_VALUE) in mark.feedback or (mark.status == "error" and mark.parts))
        and (question := marker.course.questions[mark.question]).name is not None
        and (opening := _public_call(question, marker)) is not None
    ]
    if not asked:
        return {}
    said: dict[str, _Example] = {}
    with sandbox.session(deadline) as session:
        try:
            session.run(work.cells, [])
            for question, opening in asked:
                assert question.name is not None
                reply = session.evaluate(question.name, opening)
                said[question.id] = _Example(in_words(reply.get("told")), _no_value(reply))
        except Stopped:
            pass  # what could not be found out is not told; the mark stands
    return said


def _no_value(reply: Evaluation) -> str:
    """Why what came back for an input is no value, in words."""
    outcomes: list[Outcome] = reply.get("outcomes") or []
    for outcome in outcomes:
        if "unusable" in outcome:
            return _(REASONS[outcome["unusable"]])
        if "changed" in outcome:
            return _("it changes its input in place; work on a copy")
    return ""


def _public_call(question: Question, marker: Marker) -> dict[str, object] | None:
    """The probe cut to the cases that students may see, wherever they stand among the others."""
    drawn = marker.drawn(question.id)
    public = kind_of(question).public_cases(drawn)
    if not public:
        return None
    return {**drawn.probe, "cases": [drawn.probe["cases"][i] for i in public], "tell": True}


def _with_code(mark: Mark, question: Question, work: _Work, said: dict[str, _Example]) -> Mark:
    """The mark with the student's own words: the code of the response, and what it raised."""
    if question.name is None or mark.status == "not attempted":
        return mark
    cell = defining_cell(question.name, work.cells)
    code = "" if cell is None else shown_code(work.cells[cell])
    example = said.get(question.id, _Example())
    feedback = mark.feedback
    if example.reason:
        seen = _("On the example that you can see, {reason}.").format(reason=example.reason)
        feedback = f"{feedback} {seen}"
    return replace(mark, code=code, told=mark.told or example.told, feedback=feedback)


def _line(value: object) -> str:
    """One short printable line of what a student's process said; it may have said anything."""
    text = value if isinstance(value, str) else ""
    return "".join(c if c.isprintable() else " " for c in text[:200])


def _dictionary(value: object) -> Message:
    return value if isinstance(value, dict) else {}
