"""``autograder intake``: who handed in what, when, which attempt; nothing is graded."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from autograder.cli.exit_status import BROKEN, DONE
from autograder.cli.shared_arguments import (
    Commands,
    add_class_list,
    add_json,
    add_layout,
    add_out,
    add_times,
    find_class_list,
    gradebook_path,
    load,
    print_json,
)
from autograder.language import _

if TYPE_CHECKING:
    from autograder.intake.summary import Summary


def add(commands: Commands) -> None:
    """Describe the command."""
    intake = commands.add_parser(
        "intake", help="show who handed in what, when and which attempt, without grading"
    )
    intake.add_argument("paths", nargs="+", type=Path, metavar="PATH", help="as for grade")
    add_layout(intake)
    add_times(intake)
    add_class_list(intake)
    add_out(intake)
    add_json(intake)
    intake.set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Print the table, what was passed over, and the line of truth."""
    from autograder.cli.run_options import intake_wanted
    from autograder.cli.shared_intake import take_in_paths, unreadable_students
    from autograder.gradebook import Gradebook
    from autograder.reports.terminal import printable, warn

    course = load(parsed)
    wanted = intake_wanted(parsed)
    if gradebook_path(parsed).exists():
        with Gradebook(gradebook_path(parsed), create=False) as book:
            summary = take_in_paths(wanted, course, find_class_list(parsed, book), book)
    else:
        summary = take_in_paths(wanted, course, find_class_list(parsed, None), None)
    summary.unreadable = unreadable_students(course, summary)
    if parsed.json:
        print_json(summary.to_dict())
        return BROKEN if parsed.strict and summary.needs_person else DONE
    _print_table(console, summary)
    for entry in summary.passed_over:
        console.print(
            printable(
                _("passed over: {path} ({reason})").format(path=entry.place, reason=entry.reason)
            ),
            markup=False,
            soft_wrap=True,
        )
    for remark in summary.remarks():
        warn(remark)
    said = "; ".join(summary.rules)
    closing = _("{summary}; read as {rules}.").format(summary=summary.sentence(), rules=said)
    console.print(closing, markup=False, soft_wrap=True)
    return BROKEN if parsed.strict and summary.needs_person else DONE


def _print_table(console: Console, summary: Summary) -> None:
    from autograder.reports.terminal import printable

    table = Table(box=None, pad_edge=False)
    for column in ("student", "person", "attempt", "handed in", "time from", "files"):
        table.add_column(column, overflow="fold")
    zone = summary.class_list.zone
    for row in summary.rows:
        time = row.origin.handed_in
        late = f", {row.days} days late" if row.days else ""
        said = "" if time is None else f"{time.astimezone(zone):%Y-%m-%d %H:%M:%S %Z}{late}"
        if row.only_called_late:
            said = f"{said}, called late" if said else "late, time unknown"
        people = ", ".join(person.text() for person in row.match.people)
        if summary.class_list.students and not people:
            people = "nobody"
        files = ", ".join(piece.name for piece in row.submission.pieces)
        unreadable = " (unreadable)" if row.submission.student in summary.unreadable else ""
        cells = (row.submission.student, people, row.origin.attempt, said, row.origin.time_from)
        table.add_row(*(escape(printable(text)) for text in (*cells, files + unreadable)))
    console.print(table)
