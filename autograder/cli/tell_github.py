"""What a job on GitHub is told: its summary, and remarks that stand at the files."""

from __future__ import annotations

import os
from collections.abc import Sequence

from rich.console import Console

from autograder.course import Course
from autograder.gradebook import Record
from autograder.intake.summary import Summary


def tell_github(
    console: Console, course: Course, summary: Summary, records: Sequence[Record]
) -> None:
    """Add to the job's summary, and print the remarks that GitHub shows at the files."""
    from autograder.reports import github_summary

    pieces = {row.submission.student: row.submission.pieces for row in summary.rows}
    page = os.environ.get("GITHUB_STEP_SUMMARY")
    for record in records:
        paths = [piece.path for piece in pieces.get(record.student, ())]
        notebooks = [
            found
            for path in paths
            for found in (sorted(path.rglob("*.ipynb")) if path.is_dir() else [path])
        ]
        files = {
            chapter.name: os.path.relpath(path)
            for chapter in course.chapters
            for path in notebooks
            if chapter.name in path.stem
        }
        text = github_summary.summary(course, record)
        if page:
            with open(page, "a", encoding="utf-8", newline="\n") as file:
                file.write(text)
        for line in github_summary.remarks(course, record, files):
            console.out(line, highlight=False)
