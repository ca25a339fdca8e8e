"""Writes every report of a gradebook."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

from autograder.course import Course
from autograder.errors import refuse_link
from autograder.gradebook import ClassView, Gradebook, Record, view_class
from autograder.intake.class_list import ClassList
from autograder.language import _
from autograder.reports.class_csv import write_class_csv
from autograder.reports.class_html import class_html
from autograder.reports.class_summary import gather
from autograder.reports.feedback_html import Feedback, feedback_html
from autograder.reports.grades_csv import write_grades_csv
from autograder.reports.pictures import Pictures
from autograder.reports.terminal import progress_bar
from autograder.reports.unchanged_pages import Fingerprints, has_fingerprint
from autograder.reports.whole_files import file_name, write_text


@dataclass(frozen=True)
class Options:
    """Where reports go, whose feedback may have changed (None: all), and who is in the class."""

    out: Path
    students: Collection[str] | None = None
    class_list: ClassList | None = None


def write_reports(course: Course, book: Gradebook, options: Options) -> str:
    """Write the reports and say in half a sentence which ones."""
    out = options.out
    refuse_link(out / "feedback")
    view = view_class(course, book, options.class_list or ClassList(), streamed=True)
    records = view.records
    found = gather(course, records)
    write_grades_csv(out / "grades.csv", course, records)
    write_class_csv(out, course, records, found)
    said = book.setting("intake") or ""
    write_text(out / "class.html", class_html(course, records, book.last_run(), view, said, found))
    shared = feedback_of(view, book)
    fingerprints = Fingerprints(shared, book)
    with progress_bar(_("feedback")) as progress:
        task = progress.add_task("", total=len(records))
        for record in records:
            if options.students is None or record.student in options.students:
                _write_feedback(out / "feedback", shared, record, fingerprints)
            progress.advance(task)
    said = _("{grades}, class.html and feedback/ are written")
    return said.format(grades=out / "grades.csv")


def _write_feedback(
    folder: Path, shared: Feedback, record: Record, fingerprints: Fingerprints
) -> None:
    """Write a student's page, unless it is there already and would say the same."""
    path = folder / f"{file_name(record.student)}.html"
    fingerprint = fingerprints.of(record)
    if not has_fingerprint(path, fingerprint):
        write_text(path, feedback_html(shared, record) + fingerprint)


def feedback_of(view: ClassView, book: Gradebook) -> Feedback:
    """What all pages of feedback share."""
    explanations = book.setting("explanations") == "yes"
    return Feedback(view.course, Pictures(view.course), explanations)
