"""Grades in the formats of learning systems.

Canvas: the header and the row of possible points that its gradebook import looks for
(lib/gradebook_importer.rb in instructure/canvas-lms; the Instructor Guide, "How do I import grades
in the Gradebook?"). Moodle: a CSV with columns that identify the user and columns to be mapped to a
grade item and its feedback (docs.moodle.org, "Grade import").
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from autograder.course import Course
from autograder.course.questions import Question
from autograder.gradebook.record import Record
from autograder.intake.class_list import ClassList
from autograder.intake.name_spellings import plain_name
from autograder.intake.person import Person
from autograder.language import _
from autograder.reports.grades_csv import NOT_YET, points_cell
from autograder.reports.json_output import most_for
from autograder.reports.whole_files import write_csv


def match(
    class_list: ClassList, records: Sequence[Record]
) -> tuple[list[tuple[Person, Record | None]], list[Record]]:
    """Each student of the class with the work handed in, and the work that is nobody's.

    Whose it is must be certain: of several submissions that fit one student none counts.
    """
    matches = class_list.match_all({record.student: record.origin for record in records})
    found: dict[Person, Record] = {}
    left = []
    for record in records:
        people = matches[record.student].people
        found |= dict.fromkeys(people, record)
        if not people:
            left.append(record)
    return [(student, found.get(student)) for student in class_list.students], left


def alike_for_canvas(class_list: ClassList) -> list[Person]:
    """Those of whom nothing that Canvas knows is in the class list but a name that others share."""
    named = Counter(plain_name(student.name) for student in class_list.students)
    return [
        student
        for student in class_list.students
        if not (student.id or student.sis_id or student.login)
        and named[plain_name(student.name)] > 1
    ]


def write_canvas(
    path: Path, course: Course, class_list: ClassList, records: Sequence[Record]
) -> list[Record]:
    """Write a file for Canvas's gradebook import; returns the work that is nobody's.

    Who handed in nothing, or has a question that waits for a person, gets an empty cell, which
    leaves the grade in Canvas open. Those whom it cannot tell apart are left out.
    """
    pairs, left = match(class_list, records)
    apart = set(class_list.students) - set(alike_for_canvas(class_list))
    pairs = [pair for pair in pairs if pair[0] in apart]
    number = f" ({class_list.canvas_id})" if class_list.canvas_id else ""
    header = ["Student", "ID", "SIS User ID", "SIS Login ID", "Section"]
    rows: list[list[object]] = [
        [*header, f"{class_list.title}{number}"],
        # Canvas writes the four spaces itself, so that no student sorts before this row.
        ["    Points Possible", "", "", "", "", _most(course, records)],
    ]
    for student, record in pairs:
        row = [student.name, student.id, student.sis_id, student.login, student.section]
        rows.append([*row, record.final if record else None])
    write_csv(path, rows)
    return left


def write_moodle(
    path: Path, course: Course, class_list: ClassList, records: Sequence[Record]
) -> list[Record]:
    """Write a file for Moodle's grade import; returns the work that is nobody's.

    Moodle refuses a whole file for one unknown user, and a user without grade loses the one they
    have: students who handed in nothing, and those with a question that waits for a person, are
    left out. Importing feedback without a grade would overwrite the grade, so both columns are
    there.
    """
    pairs, left = match(class_list, records)
    header = ["First name and last name", "Username", "ID number", "Email address"]
    rows: list[list[object]] = [[*header, class_list.title, f"{class_list.title} feedback"]]
    for student, record in pairs:
        if record is not None and not record.open:
            row = [student.name, student.login, student.sis_id or student.id, student.email]
            rows.append([*row, record.total, _summary(course, record)])
    write_csv(path, rows)
    return left


def write_plain(
    path: Path, course: Course, class_list: ClassList, records: Sequence[Record]
) -> list[Record]:
    """Write every question's points with what the class list knows; nobody is left out."""
    pairs, left = match(class_list, records)
    header = ["submission", "name", "id", "sis_id", "login", "email", "section", *course.questions]
    header += ["earned", "late_days", "late_deduction", "total", "max", "status", "handed_in"]
    header += ["not_yet_marked"]
    rows: list[list[object]] = [list(header)]
    nobodys: list[tuple[Person | None, Record | None]] = [(None, record) for record in left]
    for student, record in [*pairs, *nobodys]:
        person = student or Person("")
        row: list[object] = [record.student if record else None]
        row += [person.name, person.id, person.sis_id, person.login, person.email, person.section]
        row += [points_cell(record, id) if record else None for id in course.questions]
        most = _most(course, records)
        if record is None:
            row += [None, None, None, None, most, "not handed in", None, None]
        else:
            total = NOT_YET if record.open else record.total
            row += [record.earned, record.late_days, record.deduction, total, most]
            row += [record.graded.status, record.handed_in, " ".join(record.open)]
        rows.append(row)
    write_csv(path, rows)
    return left


def _most(course: Course, records: Sequence[Record]) -> float:
    return most_for(course, records[0] if records else None)


def _points_of(record: Record, question: Question) -> str:
    """A question's points for the student, and how it counts if that is not as usual."""
    scheme = record.scheme
    if scheme is not None and question.id in scheme.dropped:
        return f"{question.id} {_('dropped')}"
    if scheme is not None and not scheme.counts(question.id, record):
        return f"{question.id} {_('excused')}"
    points = f"{question.id} {record.points(question.id) or 0.0:g}/{question.points:g}"
    is_bonus = scheme is not None and question.id in scheme.bonus
    return f"{points} ({_('bonus')})" if is_bonus else points


def _summary(course: Course, record: Record) -> str:
    said = ", ".join(_points_of(record, question) for question in course.questions.values())
    late = f"; {record.late_days} days late, -{record.deduction:g}" if record.late_days else ""
    return f"{said}{late}"
