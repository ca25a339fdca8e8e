"""What GitHub shows of a graded repository: a summary of the job, and a remark at each file.

Nothing is in it that the page of feedback does not say as well: no hidden input, no right answer.
What a student wrote is not repeated, and no text can end a command and begin another.

Sources: GitHub's pages on workflow commands (``::error file=...``, ``GITHUB_STEP_SUMMARY``) and on
their escapes, %25, %0D and %0A, in properties %3A and %2C too.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from autograder.course import Course
from autograder.gradebook import Record
from autograder.questions.status import Status
from autograder.reports.json_output import most_for

_REMARKS = {"right": None, "recorded": None, "not attempted": "notice", "partial": "warning"}


def summary(course: Course, record: Record) -> str:
    """The marks of one student as Markdown: a line a question, with its feedback."""
    lines = [
        f"## {_cell(record.name)}",
        "",
        "| question | mark | points | feedback |",
        "|:--|:--|--:|:--|",
    ]
    for mark in record.graded.marks:
        title = course.question(mark.question).title
        lines.append(
            f"| {mark.question} · {_cell(title)} | {Status(mark.status).sign} {mark.status} "
            f"| {record.points(mark.question):g} of {mark.max_points:g} | {_cell(mark.feedback)} |"
        )
    notes = [f"- {_cell(note)}" for note in record.graded.notes]
    so_far = " so far" if record.open else ""
    total = f"**{record.total:g} of {most_for(course, record):g} points{so_far}**"
    return "\n".join([*lines, "", total, "", *notes, ""])


def remarks(course: Course, record: Record, files: Mapping[str, str]) -> Iterator[str]:
    """A workflow command for each question that is not right; ``files`` are notebooks."""
    for mark in record.graded.marks:
        level = _REMARKS.get(mark.status, "error")
        if level is None:
            continue
        question = course.question(mark.question)
        file = files.get(question.chapter)
        where = f"file={_property(file)}," if file else ""
        title = f"title={_property(f'{question.id} {question.title}: {mark.status}')}"
        yield f"::{level} {where}{title}::{_data(mark.feedback or mark.status)}"


def _cell(text: str) -> str:
    """A text in a cell of a table: no line, no column and no tag of its own."""
    text = " ".join(text.split()).replace("&", "&amp;").replace("<", "&lt;")
    return text.replace("|", "\\|")


def _data(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
