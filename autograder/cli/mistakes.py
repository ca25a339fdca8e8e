"""``autograder mistakes``: what a class got wrong that has no name yet, for the author to name."""

from __future__ import annotations

import argparse
import json

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
from autograder.language import _, n_


def add(commands: Commands) -> None:
    """Describe the command."""
    mistakes = commands.add_parser(
        "mistakes", help="cluster the wrong responses that have no name yet"
    )
    mistakes.add_argument(
        "--least",
        type=int,
        default=2,
        metavar="N",
        help="how many must have given the same (default: 2)",
    )
    add_out(mistakes)
    add_class_list(mistakes)
    add_json(mistakes)
    mistakes.set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Print each cluster: how many, a typical response, and an entry for the key."""
    from autograder.gradebook import Gradebook, view_class
    from autograder.reports.nameless import entry_for, nameless

    course = load(parsed)
    with Gradebook(gradebook_path(parsed), create=False) as book:
        found = nameless(
            view_class(course, book, find_class_list(parsed, book)).records, parsed.least
        )
    entries = [(cluster, entry_for(course, cluster)) for cluster in found]
    if parsed.json:
        print_json(
            [
                {
                    "question": cluster.question,
                    "students": list(cluster.students),
                    "response": cluster.typical,
                    "entry": entry,
                }
                for cluster, entry in entries
            ]
        )
        return DONE
    if not entries:
        console.print(
            _(
                "No wrong response without a name was given by {count} or more; --least 1 shows "
                "all."
            ).format(count=parsed.least)
        )
    for cluster, entry in entries:
        count = len(cluster.students)
        console.print(
            n_(
                "{question}: {count} response with the same outcomes, {students}. One of them:",
                "{question}: {count} responses with the same outcomes, {students}. One of them:",
                count,
            ).format(
                question=cluster.question,
                count=count,
                students=json.dumps(list(cluster.students), ensure_ascii=False),
            ),
            markup=False,
        )
        console.print(cluster.typical or cluster.feedback, markup=False, highlight=False)
        console.print(_("For the answers (give it a name and feedback, then run check):"))
        console.print(entry, markup=False, highlight=False)
        console.print()
    return DONE
