"""``autograder show``: everything the gradebook knows of one student."""

from __future__ import annotations

import argparse

from rich.console import Console

from autograder.cli.exit_status import DONE
from autograder.cli.shared_arguments import (
    Commands,
    add_class_list,
    add_json,
    add_out,
    find_class_list,
    gradebook_path,
    load,
    print_json,
)


def add(commands: Commands) -> None:
    """Describe the command."""
    show = commands.add_parser("show", help="show what the gradebook knows about a student")
    show.add_argument("student", metavar="STUDENT", help="name, id, login or e-mail")
    show.add_argument(
        "--key", action="store_true", help="print the student's own numbers and right answers"
    )
    add_out(show)
    add_class_list(show)
    add_json(show)
    show.set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Print marks, overrides and notes."""
    from autograder.gradebook import Gradebook, find_record, view_class
    from autograder.reports.json_output import record_fields
    from autograder.reports.terminal_student import print_key, print_record

    course = load(parsed)
    with Gradebook(gradebook_path(parsed), create=False) as book:
        view = view_class(course, book, find_class_list(parsed, book))
        record = find_record(view.records, parsed.student, view.missing)
        if parsed.key:
            print_key(console, course, record)
        elif parsed.json:
            print_json(record_fields(course, record))
        else:
            print_record(console, course, record, book.overrides(record.student))
    return DONE
