"""Gradescope: ``results.json`` for a submission, as its autograder specification describes it.

https://gradescope-autograders.readthedocs.io/en/latest/specs/
"""

from __future__ import annotations

from autograder.course import Course
from autograder.course.questions import Question
from autograder.gradebook.record import Record
from autograder.marking import Mark
from autograder.questions.status import Status
from autograder.reports.json_output import most_points
from autograder.reports.terminal import printable


def results(course: Course, record: Record, explanations: bool = False) -> dict[str, object]:
    """The results of one submission, a test for each question.

    All text is plain: what students wrote is shown as it is. The score stands at the top too,
    since lateness is taken off there.
    """
    notes = [printable(note) for note in record.graded.notes]
    if record.late_days:
        notes.append(
            f"{record.late_days} days late: {record.late_percent:g} % off, "
            f"that is {record.deduction:g} points."
        )
    return {
        "score": record.total,
        "execution_time": round(record.graded.seconds, 2),
        "output": "\n".join(notes) or f"{record.total:g} of {most_points(course):g} points.",
        "output_format": "text",
        "test_output_format": "text",
        "test_name_format": "text",
        "visibility": "visible",
        "stdout_visibility": "hidden",
        "tests": [_test(question, record, explanations) for question in course.questions.values()],
    }


def failure(sentence: str, most: float) -> dict[str, object]:
    """Results that say to students that grading failed, and earn nothing yet."""
    return {
        "score": 0.0,
        "output": f"Grading failed, and that is not your fault; your instructor will see to it. "
        f"({printable(sentence)})",
        "output_format": "text",
        "stdout_visibility": "hidden",
        "tests": [{"name": "Grading", "score": 0.0, "max_score": most, "status": "failed"}],
    }


def _test(question: Question, record: Record, explanations: bool) -> dict[str, object]:
    mark = record.marks.get(question.id)
    points = record.points(question.id) or 0.0
    return {
        "number": question.id,
        "name": printable(question.title),
        "score": points,
        "max_score": question.points,
        "status": "passed" if points >= question.points else "failed",
        "output": _output(record, question, mark, explanations),
        "visibility": "visible",
    }


def _output(record: Record, question: Question, mark: Mark | None, explanations: bool) -> str:
    lines = []
    override = record.overrides.get(question.id)
    if override is not None:
        lines.append(f"Marked by hand: {override.points:g} points. {override.reason}")
    if mark is None:
        lines.append("Not marked.")
    else:
        lines.append(f"{Status(mark.status).words}. {mark.feedback}")
        if mark.understood and mark.status != "not attempted":
            lines.append(f"Your response was read as: {mark.understood}")
        lines += [
            f"- {part.label}: {part.feedback}"
            for part in mark.parts
            if part.right is not True and part.feedback
        ]
        if explanations and mark.full_explanation:
            lines += ["", *mark.full_explanation.splitlines()]
    return "\n".join(printable(line) for line in lines)
