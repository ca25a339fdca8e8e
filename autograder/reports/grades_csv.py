"""``grades.csv``: a row a student, a column a question."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from autograder.course import Course
from autograder.gradebook.record import Record
from autograder.reports.json_output import most_for
from autograder.reports.whole_files import write_csv

NOT_YET = "not yet"


def points_cell(record: Record, question: str) -> float | str | None:
    """The points for a question, or "not yet" while it waits for a person."""
    return NOT_YET if question in record.open else record.points(question)


def write_grades_csv(path: Path, course: Course, records: Iterable[Record]) -> None:
    """Write student, points for each question, total, max and status, whole or not at all.

    Then come what lateness cost, which questions were marked by hand and which wait for a person
    (their points are "not yet"), what kept the student's code in, and whose work it is.
    """
    write_csv(path, _rows(course, records))


def _rows(course: Course, records: Iterable[Record]) -> Iterator[Sequence[object]]:
    header = ["student", *course.questions, "total", "max", "status"]
    header += ["late_days", "late_deduction", "marked_by_hand", "isolation"]
    yield [*header, "not_yet_marked", "name", "section"]
    for record in records:
        yield [
            record.student,
            *(points_cell(record, id) for id in course.questions),
            NOT_YET if record.open else record.total,
            most_for(course, record),
            record.graded.status,
            record.late_days,
            record.deduction,
            " ".join(record.overrides),
            record.isolation,
            " ".join(record.open),
            record.name,
            ", ".join(dict.fromkeys(p.section for p in record.people if p.section)),
        ]
