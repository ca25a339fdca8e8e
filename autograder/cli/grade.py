"""``autograder grade``: mark submissions and write the reports."""

from __future__ import annotations

import argparse
from pathlib import Path

from rich.console import Console

from autograder.cli.shared_arguments import (
    Commands,
    add_grading,
    add_layout,
    gradebook_path,
    load,
    use_class_list,
)
from autograder.errors import UsageError


def add(commands: Commands) -> None:
    """Describe the command."""
    grade = commands.add_parser("grade", help="mark submissions and write the reports")
    grade.add_argument(
        "paths",
        nargs="+",
        type=Path,
        metavar="PATH",
        help="a zip, a notebook, a folder of one student, or a folder of submissions",
    )
    grade.add_argument("--regrade", action="store_true", help="mark again what was marked before")
    grade.add_argument(
        "--summary",
        choices=["github"],
        help="in a workflow of GitHub: a summary of the job, and a remark at each notebook",
    )
    add_layout(grade)
    add_grading(grade)
    grade.set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Grade what is at the paths; what was graded before with the same key is not run again."""
    from autograder.cli.grading_run import grade_and_report
    from autograder.cli.run_options import grading_wanted, intake_wanted
    from autograder.cli.shared_intake import take_in_paths
    from autograder.gradebook import Gradebook

    course = load(parsed)
    assert course.key  # a broken key is said before anything runs
    for path in parsed.paths:  # before a gradebook is begun for nothing
        if not path.exists():
            raise UsageError(f"There is nothing at {path}; name a file or folder that exists.")
    with Gradebook(gradebook_path(parsed), create=not parsed.dry_run) as book:
        class_list = use_class_list(parsed, book)
        summary = take_in_paths(intake_wanted(parsed), course, class_list, book)
        wanted = grading_wanted(parsed, parsed.regrade)
        return grade_and_report(wanted, console, course, book, summary)
