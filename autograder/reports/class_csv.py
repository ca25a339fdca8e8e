"""What ``class.html`` shows, as tables for other programs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from autograder.course import Course
from autograder.gradebook.record import Record
from autograder.marking import STATUSES
from autograder.reports.class_summary import ClassFindings, gather
from autograder.reports.who_needs_help import needs_help, section_of
from autograder.reports.whole_files import write_csv


def write_class_csv(
    folder: Path, course: Course, records: Sequence[Record], found: ClassFindings | None = None
) -> None:
    """Write the tables of a class: class_questions.csv, class_mistakes.csv, class_students.csv.

    If the course asks for predictions there is class_predictions.csv as well.

    ``found`` is what was gathered from the records, if that was done before.
    """
    found = found or gather(course, records)
    header = ["question", "title", "points", *STATUSES, "attempted"]
    rows: list[list[object]] = [[*header, "earned_share", "discrimination", "unnamed", "troubles"]]
    for entry in found.questions:
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
    for mistake in found.mistakes:
        names = "; ".join(mistake.students)
        named = "yes" if mistake.named else "no"
        rows.append([mistake.question, mistake.name, named, len(mistake.students), names])
    write_csv(folder / "class_mistakes.csv", rows)
    write_csv(folder / "class_students.csv", _students(course, records))
    if course.predictions:
        rows = [["prediction", "predicted", "count"]]
        rows += [[e.asked.id, name, count] for e in found.predicted for name, count in e.rows()]
        write_csv(folder / "class_predictions.csv", rows)


def _students(course: Course, records: Iterable[Record]) -> Iterator[Sequence[object]]:
    yield (
        *("student", "total", "status", "seconds", "needs_help", "problems"),
        *("name", "section", "below_half_in", "mistakes", "not_yet_marked"),
    )
    for record in records:
        needy = needs_help(course, record)
        yield [
            record.student,
            record.total,
            record.graded.status,
            round(record.graded.seconds, 3),
            "; ".join(needy.reasons) if needy else "",
            " ".join(record.graded.notes),
            record.name,
            section_of(record),
            "; ".join(needy.chapters) if needy else "",
            "; ".join(f"{id} {name}" for id, name in needy.mistakes) if needy else "",
            " ".join(record.open),
        ]


def _rounded(value: float | None) -> float | None:
    return None if value is None else round(value, 3)
