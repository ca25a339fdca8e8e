"""What the commands print: progress, tables, differences, one student."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from itertools import groupby

from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Table

from autograder.course import Course
from autograder.exchange.printable import printable as without_controls
from autograder.gradebook.changes import Change
from autograder.gradebook.record import Record
from autograder.gradebook.student_names import names_of
from autograder.language import _, n_
from autograder.marking import Mark
from autograder.questions.status import Status
from autograder.reports.json_output import most_for

NARROW = 60  # columns, below which tables are written as lines


def progress_bar(doing: str = "") -> Progress:
    """A bar with the count and the time that is left; silent when nobody watches.

    It goes to standard error, so that standard output holds results only.
    """
    console = Console(stderr=True, highlight=False)
    return Progress(
        TextColumn(doing or _("grading")),
        BarColumn(),
        MofNCompleteColumn(),
        TimeRemainingColumn(),
        TextColumn("{task.description}"),
        console=console,
        transient=True,
        disable=not console.is_terminal,
    )


def warn(sentence: str) -> None:
    """Say something on standard error."""
    print(f"autograder: {printable(sentence)}", file=sys.stderr)


def print_table(console: Console, course: Course, records: Sequence[Record]) -> None:
    """A row a student: a sign for each question, grouped by chapter, and the total.

    On a narrow terminal each student has lines instead.
    """
    if console.width < NARROW:
        _print_lines(console, course, records)
        return
    table = Table(box=None, pad_edge=False)
    table.add_column(_("student"), overflow="fold")
    for chapter in course.chapters:
        table.add_column(chapter.title, overflow="fold")
    table.add_column(_("points"), justify="right")
    table.add_column("", overflow="fold")
    names = names_of(records)
    for record in records:
        marks = record.marks
        signs = [
            "".join(
                colored_sign(marks[question.id].status) if question.id in marks else " "
                for question in chapter.questions
            )
            for chapter in course.chapters
        ]
        table.add_row(
            escape(printable(names[record.student])),
            *signs,
            f"{record.total:g} / {most_for(course, record):g}" + (" +?" if record.open else ""),
            escape(printable(" ".join(map(_, record.graded.notes)))),
        )
    console.print(table)
    console.print(f"[dim]{legend()}[/]")


def _print_lines(console: Console, course: Course, records: Sequence[Record]) -> None:
    names = names_of(records)
    for record in records:
        marks = record.marks
        print_line(
            console, f"{names[record.student]}: {record.total:g} / {most_for(course, record):g}"
        )
        for chapter in course.chapters:
            signs = "".join(
                Status(marks[question.id].status).sign if question.id in marks else " "
                for question in chapter.questions
            )
            print_line(console, f"  {signs}  {chapter.title}")
        for note in record.graded.notes:
            print_line(console, f"  ! {_(note)}")
    print_line(console, legend())


def print_changes(console: Console, earned: Mapping[str, float], changes: Sequence[Change]) -> None:
    """A line a student whose marks changed: the totals, and every mark before and after.

    ``earned`` are the points before; ``changes`` are in the order of students.
    """
    count = 0
    for student, entries in groupby(changes, key=lambda change: change.student):
        count += 1
        of_student = list(entries)
        before = earned[student]
        gained = sum(change.points for change in of_student)
        sentence = _("{student}: {before} → {after} points")
        after = f"{round(before + gained, 2):g}"
        print_line(console, sentence.format(student=student, before=f"{before:g}", after=after))
        for change in of_student:
            kept = f"; {_('the override stays')}" if change.overridden else ""
            print_line(
                console,
                f"  {change.question}: {_verdict(change.before)} → {_verdict(change.after)}{kept}",
            )
    if not changes:
        print_line(console, _("No mark differs."))
        return
    sentence = n_(
        "{marks} marks of {count} student differ.",
        "{marks} marks of {count} students differ.",
        count,
    )
    print_line(console, sentence.format(marks=len(changes), count=count))


def printable(text: str) -> str:
    """Text without control characters, so that no name can write to the terminal."""
    return without_controls(text, "�")


def print_line(console: Console, text: str) -> None:
    """Print a text of any origin as one line, without control characters or colours."""
    console.print(printable(text), markup=False, soft_wrap=True)


def legend() -> str:
    """What the signs of a table mean."""
    return "  ".join(f"{status.sign} {_(status)}" for status in Status)


def colored_sign(status: str) -> str:
    """The sign of a status in its colour, as Rich marks it up."""
    return f"[{Status(status).color}]{Status(status).sign}[/]"


def _verdict(mark: Mark) -> str:
    named = mark.alternative if mark.alternative not in (None, mark.status) else ""
    return f"{mark.points:g} ({_(mark.status)}{', ' if named else ''}{named})"


MOST_IN_A_TABLE = 500  # students
