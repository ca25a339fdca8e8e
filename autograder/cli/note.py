"""``autograder note``: a remark about a student, for the instructors only."""

from __future__ import annotations

import argparse

from rich.console import Console

from autograder.cli.exit_status import DONE
from autograder.cli.shared_arguments import (
    Commands,
    add_author,
    add_class_list,
    add_out,
    gradebook_path,
    use_class_list,
)
from autograder.errors import UsageError


def add(commands: Commands) -> None:
    """Describe the command."""
    note = commands.add_parser("note", help="add a remark about a student, for instructors only")
    note.add_argument("student", metavar="STUDENT", help="name, id, login or e-mail")
    note.add_argument("text", metavar="TEXT")
    add_author(note)
    add_class_list(note)
    add_out(note)
    note.set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Keep the note."""
    from autograder.gradebook import Gradebook, find_record
    from autograder.gradebook.view import with_people
    from autograder.reports.terminal import printable

    if not parsed.text.strip():
        raise UsageError("The note is empty; write what is to be remembered.")
    with Gradebook(gradebook_path(parsed), create=False) as book:
        records, _ = with_people(book.records(), use_class_list(parsed, book))
        record = find_record(records, parsed.student)
        book.note(record.student, parsed.text.strip(), parsed.author)
    console.print(f"Noted for {printable(record.name)}.", markup=False, soft_wrap=True)
    return DONE
