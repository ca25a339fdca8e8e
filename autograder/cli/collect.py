"""``autograder collect``: what students put into a drop folder, as a folder to grade."""

from __future__ import annotations

import argparse
from pathlib import Path

from rich.console import Console

from autograder.cli.exit_status import BROKEN, DONE
from autograder.cli.shared_arguments import Commands, load
from autograder.course import Settings
from autograder.errors import AutograderError, CourseError


def add(commands: Commands) -> None:
    """Describe the command."""
    collect = commands.add_parser(
        "collect", help="take the newest of each student from a drop folder, with its time"
    )
    collect.add_argument("drop", type=Path, metavar="DROP", help="where submit(to=...) puts files")
    collect.add_argument(
        "--out",
        type=Path,
        required=True,
        metavar="CLASS",
        help="the folder for a zip of each student and times.csv, which grade reads",
    )
    collect.add_argument(
        "--trust-names",
        action="store_true",
        help="believe the names of files: for a hub that runs all students as one user",
    )
    collect.set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Copy the newest of each, and say what was left and why."""
    from autograder.intake import drop_folder
    from autograder.reports.terminal import printable, warn

    try:
        settings = load(parsed).settings
    except CourseError:
        settings = Settings()  # whoever collects need not have the course
    found = drop_folder.collect(parsed.drop, settings.submission_mb * 2**20, parsed.trust_names)
    try:
        new = list(drop_folder.write_class(found, parsed.out))
        gone = drop_folder.withdrawn(found, parsed.out)
    except OSError as error:
        raise AutograderError(
            f"{parsed.out} cannot be written: {error.strerror or error}."
        ) from None
    for entry in found.newest:
        fresh = " (new)" if entry.login in new else ""
        console.print(
            printable(f"{entry.login}  {entry.time.astimezone():%Y-%m-%d %H:%M:%S %Z}{fresh}"),
            markup=False,
            soft_wrap=True,
        )
    for name in sorted(gone):
        sentence = f"{printable(name)} was collected before and is in the drop folder no more"
        warn(f"{sentence}; it stays in {parsed.out} with its time, unless you delete it")
    for reason in found.left:
        warn(f"not taken: {printable(reason)}")
    console.print(
        f"{len(found.newest)} students, {found.earlier} earlier files passed over, "
        f"{len(found.left)} not taken. Now: autograder grade {parsed.out}",
        markup=False,
        soft_wrap=True,
    )
    return BROKEN if found.left else DONE
