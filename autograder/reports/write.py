"""Writes every report of a gradebook."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console

from autograder.course import Course
from autograder.gradebook import Gradebook
from autograder.reports.class_csv import write_class_csv
from autograder.reports.class_html import class_html
from autograder.reports.feedback_html import Feedback, feedback_html
from autograder.reports.files import file_name, write_text
from autograder.reports.grades_csv import write_grades_csv
from autograder.reports.pictures import Pictures
from autograder.reports.terminal import progress_bar


@dataclass(frozen=True)
class Options:
    """Where reports go, and whose feedback may have changed (None: everybody's)."""

    out: Path
    students: Collection[str] | None = None


def write_reports(course: Course, book: Gradebook, options: Options, console: Console) -> str:
    """Write the reports and say in half a sentence which ones."""
    out = options.out
    records = book.records()
    run = book.last_run()
    write_grades_csv(out / "grades.csv", course, records)
    write_class_csv(out, course, records)
    write_text(out / "class.html", class_html(course, records, run))
    shared = Feedback(course, Pictures(course), book.setting("explanations") == "yes")
    chosen = [
        record
        for record in records
        if options.students is None or record.student in options.students
    ]
    with progress_bar("feedback") as progress:
        task = progress.add_task("", total=len(chosen))
        for record in chosen:
            name = f"{file_name(record.student)}.html"
            write_text(out / "feedback" / name, feedback_html(shared, record))
            progress.advance(task)
    return f"{out / 'grades.csv'}, class.html and feedback/ are written"
