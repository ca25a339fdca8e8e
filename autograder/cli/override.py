"""``autograder override``: points that a person gives, whatever the grader says."""

from __future__ import annotations

import argparse
import math

from rich.console import Console

from autograder.cli.common import Commands, add_out, gradebook_path, load
from autograder.cli.status import DONE
from autograder.errors import UsageError


def add(commands: Commands) -> None:
    """Describe the command."""
    override = commands.add_parser(
        "override", help="give points by hand; they survive every regrading"
    )
    override.add_argument("student", metavar="STUDENT")
    override.add_argument("question", metavar="ID", help="the question, such as Q3.2.1")
    override.add_argument(
        "points", metavar="POINTS", help="the points, or `none` to withdraw an override"
    )
    override.add_argument("--reason", required=True, metavar="TEXT", help="shown to the student")
    add_out(override)
    override.set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Keep the override and write the student's reports again."""
    from autograder.gradebook import Gradebook
    from autograder.reports.terminal import printable
    from autograder.reports.write import Options, write_reports

    course = load(parsed)
    question = course.question(parsed.question)
    points = _points(parsed.points)
    if not parsed.reason.strip():
        raise UsageError("The reason is empty; say why, the student will read it.")
    with Gradebook(gradebook_path(parsed), create=False) as book:
        record = book.record(parsed.student)
        if points is None and question.id not in record.overrides:
            raise UsageError(f"{record.student} has no override for {question.id} to withdraw.")
        if points is not None and points > question.points:
            console.print(
                f"Note: that is more than the {question.points:g} points of the question."
            )
        book.override(record.student, question.id, points, parsed.reason.strip())
        write_reports(course, book, Options(parsed.out, {record.student}), console)
        record = book.record(record.student)
    counts = record.points(question.id) or 0.0
    console.print(
        f"{printable(record.student)} has {counts:g} points for {question.id}, "
        f"{record.total:g} together.",
        markup=False,
        soft_wrap=True,
    )
    return DONE


def _points(text: str) -> float | None:
    if text.casefold() == "none":
        return None
    try:
        points = float(text)
    except ValueError:
        points = math.nan
    if not (math.isfinite(points) and points >= 0):
        raise UsageError(f"{text!r} are no points; give a number of at least 0, or `none`.")
    return round(points, 2)
