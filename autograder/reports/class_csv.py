"""What ``class.html`` shows, as tables for other programs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from autograder.course import Course
from autograder.gradebook.record import Record
from autograder.marking import STATUSES
from autograder.reports.files import write_csv
from autograder.reports.statistics import (
    common_mistakes,
    question_statistics,
    section_of,
    who_needs_help,
)


def write_class_csv(folder: Path, course: Course, records: Sequence[Record]) -> None:
    """Write class_questions.csv, class_mistakes.csv and class_students.csv."""
    header = ["question", "title", "points", *STATUSES, "attempted"]
    rows: list[list[object]] = [[*header, "earned_share", "discrimination", "unnamed", "troubles"]]
    for entry in question_statistics(course, records):
        question = entry.question
        rows.append(
            [
                question.id,
                question.title,
                question.points,
                *(entry.statuses[status] for status in STATUSES),
                entry.attempted,
                _rounded(entry.difficulty),
                _rounded(entry.discrimination),
                entry.unnamed,
                " ".join(entry.troubles),
            ]
        )
    write_csv(folder / "class_questions.csv", rows)
    rows = [["question", "mistake", "named", "count", "students"]]
    for mistake in common_mistakes(course, records):
        names = "; ".join(mistake.students)
        named = "yes" if mistake.named else "no"
        rows.append([mistake.question, mistake.name, named, len(mistake.students), names])
    write_csv(folder / "class_mistakes.csv", rows)
    needy = {entry.student: entry for entry in who_needs_help(course, records)}
    rows = [["student", "total", "status", "seconds", "needs_help", "problems"]]
    rows[0] += ["name", "section", "below_half_in", "mistakes", "not_yet_marked"]
    for record in records:
        rows.append(
            [
                record.student,
                record.total,
                record.graded.status,
                round(record.graded.seconds, 3),
                "; ".join(found.reasons) if (found := needy.get(record.student)) else "",
                " ".join(record.graded.notes),
                record.name,
                section_of(record),
                "; ".join(found.chapters) if found else "",
                "; ".join(f"{id} {name}" for id, name in found.mistakes) if found else "",
                " ".join(record.open),
            ]
        )
    write_csv(folder / "class_students.csv", rows)


def _rounded(value: float | None) -> float | None:
    return None if value is None else round(value, 3)
