"""Writes every report of a gradebook."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console

from autograder.course import Course
from autograder.gradebook import Gradebook
from autograder.reports.grades_csv import write_grades_csv


@dataclass(frozen=True)
class Options:
    """Where reports go, the class list (None: the one in ``out``, if there is one), for whom.

    ``students`` are those whose feedback may have changed; None stands for everybody.
    """

    out: Path
    class_list: Path | None = None
    students: Collection[str] | None = None


def write_reports(course: Course, book: Gradebook, options: Options, console: Console) -> str:
    """Write the reports and say in half a sentence which ones."""
    write_grades_csv(options.out / "grades.csv", course, book.records())
    return str(options.out / "grades.csv")
