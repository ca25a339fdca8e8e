"""What a function does with the inputs that students may see: told where it gave no value."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from autograder.course.questions import Question
from autograder.exchange.exception_text import in_words
from autograder.exchange.messages import Evaluation, Outcome
from autograder.exchange.why_unusable import REASONS
from autograder.grading.collected_work import Work
from autograder.grading.own_exceptions import defining_cell, shown_code
from autograder.language import _
from autograder.marking import Mark
from autograder.marking.marker import Marker
from autograder.questions.mark import NO_VALUE
from autograder.questions.registry import kind_of
from autograder.sandbox.launcher import Sandbox, Stopped


@dataclass(frozen=True)
class Example:
    """What a function does with the input that students may see: raises, or gives no value."""

    told: str = ""
    reason: str = ""


def ask_about_the_example(
    marks: Sequence[Mark], work: Work, marker: Marker, sandbox: Sandbox, deadline: float
) -> dict[str, Example]:
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
    said: dict[str, Example] = {}
    with sandbox.session(deadline) as session:
        try:
            session.run(work.cells, [])
            for question, opening in asked:
                assert question.name is not None
                reply = session.evaluate(question.name, opening)
                said[question.id] = Example(in_words(reply.get("told")), _no_value(reply))
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


def with_code(mark: Mark, question: Question, work: Work, said: dict[str, Example]) -> Mark:
    """The mark with the student's own words: the code of the response, and what it raised."""
    if question.name is None or mark.status == "not attempted":
        return mark
    cell = defining_cell(question.name, work.cells)
    code = "" if cell is None else shown_code(work.cells[cell])
    example = said.get(question.id, Example())
    feedback = mark.feedback
    if example.reason:
        seen = _("On the example that you can see, {reason}.").format(reason=example.reason)
        feedback = f"{feedback} {seen}"
    return replace(mark, code=code, told=mark.told or example.told, feedback=feedback)
