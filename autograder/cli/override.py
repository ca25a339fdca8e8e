"""``autograder override``: points that a person gives, whatever the grader says."""

from __future__ import annotations

import argparse
import math
from pathlib import Path

from rich.console import Console

from autograder.cli.exit_status import DONE
from autograder.cli.shared_arguments import (
    Commands,
    add_author,
    add_class_list,
    add_out,
    gradebook_path,
    load,
    use_class_list,
)
from autograder.errors import UsageError


def add(commands: Commands) -> None:
    """Describe the command."""
    override = commands.add_parser(
        "override", help="give points by hand; they survive every regrading"
    )
    override.add_argument("student", nargs="?", metavar="STUDENT", help="name, id, login or e-mail")
    override.add_argument("question", nargs="?", metavar="ID", help="such as Q3.2.1")
    override.add_argument(
        "points", nargs="?", metavar="POINTS", help="the points, or `none` to withdraw an override"
    )
    override.add_argument("--reason", metavar="TEXT", help="shown to the student")
    override.add_argument(
        "--write",
        type=Path,
        metavar="FILE",
        help="write a spreadsheet (overrides.csv) of what is marked by hand or waits for it",
    )
    override.add_argument(
        "--read", type=Path, metavar="FILE", help="take the points of such a spreadsheet"
    )
    override.add_argument("--all", action="store_true", help="with --write: every question")
    override.add_argument("--dry-run", action="store_true", help="with --read: only show them")
    add_author(override)
    add_class_list(override)
    add_out(override)
    override.set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Keep the override and write the student's reports again."""
    if parsed.write or parsed.read:
        return _spreadsheet(parsed, console)
    if parsed.points is None:
        raise UsageError(
            "Name a student, a question and the points, such as `override ada Q1.1 2 --reason "
            "TEXT`, or a spreadsheet with --write or --read."
        )
    if parsed.reason is None or not parsed.reason.strip():
        raise UsageError("The reason is empty; say why with --reason, the student will read it.")
    from autograder.gradebook import Gradebook, find_record, view_class
    from autograder.reports.terminal import printable
    from autograder.reports.write import Options, write_reports

    course = load(parsed)
    question = course.question(parsed.question)
    points = read_points(parsed.points)
    with Gradebook(gradebook_path(parsed), create=False) as book:
        class_list = use_class_list(parsed, book)
        view = view_class(course, book, class_list)
        record = find_record(view.records, parsed.student, view.missing)
        decided = question.id in record.overrides or question.id in record.disputes
        if points is None and not decided:
            raise UsageError(f"{record.name} has no override for {question.id} to withdraw.")
        if points is not None and points > question.points:
            console.print(
                f"Note: that is more than the {question.points:g} points of the question."
            )
        book.override(record.student, question.id, points, parsed.reason.strip(), parsed.author)
        options = Options(parsed.out, {record.student}, class_list)
        write_reports(course, book, options)
        record = find_record(view_class(course, book, class_list).records, record.student)
    counts = record.points(question.id)
    has = "no points yet" if counts is None else f"{counts:g} points"
    console.print(
        f"{printable(record.name)} has {has} for {question.id}, {record.total:g} together.",
        markup=False,
        soft_wrap=True,
    )
    return DONE


def _spreadsheet(parsed: argparse.Namespace, console: Console) -> int:
    from autograder.gradebook import Gradebook, view_class
    from autograder.reports.overrides_csv import read_spreadsheet, write_spreadsheet
    from autograder.reports.terminal import printable
    from autograder.reports.write import Options, write_reports

    if parsed.write and parsed.read:
        raise UsageError("Choose one of --write and --read.")
    course = load(parsed)
    with Gradebook(gradebook_path(parsed), create=False) as book:
        class_list = use_class_list(parsed, book)
        view = view_class(course, book, class_list)
        if parsed.write:
            count = write_spreadsheet(parsed.write, view, everything=parsed.all)
            said = f"{parsed.write} has {count} rows; fill in points, then --read it."
            console.print(said, markup=False, soft_wrap=True)
            return DONE
        found = read_spreadsheet(parsed.read, view, parsed.author)
        for entry in found:
            points = "withdrawn" if entry.points is None else f"{entry.points:g} points"
            said = f"{entry.student} {entry.question}: {points} ({entry.reason})"
            console.print(printable(said), markup=False, soft_wrap=True)
        if not parsed.dry_run and found:
            book.add(found, [])
            students = {entry.student for entry in found}
            write_reports(course, book, Options(parsed.out, students, class_list))
    kept = "nothing was written" if parsed.dry_run else "kept in the gradebook"
    console.print(f"{len(found)} differ from the gradebook; {kept}.")
    return DONE


def read_points(text: str) -> float | None:
    """The points that somebody wrote; None for ``none``.

    Raises:
        UsageError: if it is no number of at least 0.
    """
    if text.strip().casefold() == "none":
        return None
    try:
        points = float(text.strip().replace(",", "."))
    except ValueError:
        points = math.nan
    if not (math.isfinite(points) and points >= 0):
        raise UsageError(
            f"{text!r} is not a number of points; give a number of at least 0, or `none`."
        )
    return round(points, 2)
