"""``autograder note``: a remark about a student, for the instructors only."""

from __future__ import annotations

import argparse

from rich.console import Console

from autograder.cli.common import Commands, add_out, gradebook_path
from autograder.cli.status import DONE
from autograder.errors import UsageError


def add(commands: Commands) -> None:
    """Describe the command."""
    note = commands.add_parser("note", help="add a remark about a student, for instructors only")
    note.add_argument("student", metavar="STUDENT")
    note.add_argument("text", metavar="TEXT")
    add_out(note)
    note.set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Keep the note."""
    from autograder.gradebook import Gradebook
    from autograder.reports.terminal import printable

    if not parsed.text.strip():
        raise UsageError("The note is empty; write what is to be remembered.")
    with Gradebook(gradebook_path(parsed), create=False) as book:
        student = book.record(parsed.student).student
        book.note(student, parsed.text.strip())
    console.print(f"Noted for {printable(student)}.", markup=False, soft_wrap=True)
    return DONE
