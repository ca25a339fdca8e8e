"""``autograder regrade``: mark the whole class again, from where its work was found."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from typing import TYPE_CHECKING

from rich.console import Console

from autograder.cli.shared_arguments import (
    Commands,
    add_grading,
    gradebook_path,
    load,
    use_class_list,
)
from autograder.errors import UsageError

if TYPE_CHECKING:
    from autograder.gradebook import Record


def add(commands: Commands) -> None:
    """Describe the command."""
    regrade = commands.add_parser(
        "regrade", help="mark the class again, after the key has changed; see --dry-run"
    )
    regrade.add_argument(
        "students", nargs="*", metavar="STUDENT", help="only these (default: everybody)"
    )
    add_grading(regrade)
    regrade.set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Grade again what the gradebook knows; work that has gone keeps its marks, and is named."""
    from autograder.cli.grading_run import grade_and_report
    from autograder.cli.run_options import grading_wanted, intake_wanted
    from autograder.cli.shared_intake import settle
    from autograder.gradebook import Gradebook, find_record, view_class
    from autograder.gradebook.view import with_people
    from autograder.intake.long_list import LongList
    from autograder.intake.submissions import Submission
    from autograder.reports.terminal import warn

    course = load(parsed)
    assert course.key  # a broken key is said before anything runs
    with Gradebook(gradebook_path(parsed), create=False) as book:
        class_list = use_class_list(parsed, book)
        chosen: Iterable[Record] = view_class(course, book, class_list, streamed=True).records
        if parsed.students:
            records, _ = with_people(book.records(), class_list)
            chosen = [find_record(records, student) for student in parsed.students]
        remaining: LongList[Submission] = LongList(Submission)
        for record in chosen:
            submission = record.graded.submission
            if submission.path.exists():
                remaining.append(submission)
            else:
                warn(
                    f"The work of {record.name} is no longer at {submission.path}; "
                    "its marks stay as they are."
                )
        if not remaining:
            raise UsageError("There is nothing to grade again; run `autograder grade PATH`.")
        summary = settle(intake_wanted(parsed), class_list, remaining, book)
        wanted = grading_wanted(parsed, regrade=True)
        return grade_and_report(wanted, console, course, book, summary)
