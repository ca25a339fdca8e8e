"""Records and changes as plain data, for ``--json``."""

from __future__ import annotations

from autograder.course import Course
from autograder.gradebook import Record
from autograder.gradebook.changes import Change


def record_fields(course: Course, record: Record) -> dict[str, object]:
    """One student, with the verdict on every question that was marked."""
    return {
        "student": record.student,
        "name": record.name,
        "people": [person.text() for person in record.people],
        "status": record.graded.status,
        "total": record.total,
        "max": most_for(course, record),
        "open": {question: record.open_reason(question) for question in record.open},
        "isolation": record.isolation,
        "late_days": record.late_days,
        "deduction": record.deduction,
        "problems": list(record.graded.notes),
        "notes": [note.text for note in record.notes],
        "questions": {
            mark.question: {
                "status": mark.status,
                "points": record.points(mark.question),
                "max": mark.max_points,
                "alternative": mark.alternative,
                "evidence": mark.evidence,
                "understood": mark.understood,
                "feedback": mark.feedback,
                "override": (
                    record.overrides[mark.question].reason
                    if mark.question in record.overrides
                    else None
                ),
            }
            for mark in record.graded.marks
        },
    }


def change_fields(change: Change) -> dict[str, object]:
    """One mark before and after."""
    return {
        "student": change.student,
        "question": change.question,
        "before": {
            "points": change.before.points,
            "status": change.before.status,
            "alternative": change.before.alternative,
        },
        "after": {
            "points": change.after.points,
            "status": change.after.status,
            "alternative": change.after.alternative,
        },
        "overridden": change.overridden,
    }


def most_points(course: Course) -> float:
    """What a perfect submission earns."""
    return round(sum(question.points for question in course.questions.values()), 2)


def most_for(course: Course, record: Record | None) -> float:
    """What a perfect submission earns under the scheme that was accepted."""
    if record is None or record.scheme is None:
        return most_points(course)
    return record.scheme.most
