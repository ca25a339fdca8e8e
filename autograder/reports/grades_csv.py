"""``grades.csv``: a row a student, a column a question."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from autograder.course import Course
from autograder.gradebook.record import Record
from autograder.reports.files import write_csv
from autograder.reports.machine import most_points


def write_grades_csv(path: Path, course: Course, records: Sequence[Record]) -> None:
    """Write student, points for each question, total, max and status, whole or not at all.

    Then come what lateness cost, and which questions were marked by hand, and what
    kept the student's code in.
    """
    header = ["student", *course.questions, "total", "max", "status"]
    rows: list[list[object]] = [
        [*header, "late_days", "late_deduction", "marked_by_hand", "isolation"]
    ]
    for record in records:
        rows.append(
            [
                record.student,
                *(record.points(id) for id in course.questions),
                record.total,
                most_points(course),
                record.graded.status,
                record.late_days,
                record.deduction,
                " ".join(record.overrides),
                record.isolation,
            ]
        )
    write_csv(path, rows)
