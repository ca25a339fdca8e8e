"""``grades.csv``: a row a student, a column a question."""

from __future__ import annotations

import csv
import os
from collections.abc import Sequence
from pathlib import Path

from autograder.course import Course
from autograder.grading import Graded


def write_grades_csv(path: Path, course: Course, graded: Sequence[Graded]) -> None:
    """Write student, points for each question, total, max and status, whole or not at all."""
    most = sum(question.points for question in course.questions.values())
    unfinished = path.with_suffix(".csv.tmp")
    with unfinished.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["student", *course.questions, "total", "max", "status"])
        for entry in graded:
            points = {mark.question: f"{mark.points:g}" for mark in entry.marks}
            writer.writerow(
                [
                    defused(entry.submission.student),
                    *(points.get(id, "") for id in course.questions),
                    f"{entry.total:g}",
                    f"{most:g}",
                    entry.status,
                ]
            )
    os.replace(unfinished, path)


def defused(text: str) -> str:
    """Text that no spreadsheet takes for a formula."""
    return "'" + text if text[:1] in ("=", "+", "-", "@", "\t", "\r") else text
