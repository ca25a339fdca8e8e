"""``overrides.csv``: marking by hand in a spreadsheet, out and in again.

A row is a student and a question. ``points`` and ``comment`` are to be filled in; the rest is there
to be read. Semicolons, a byte order mark and decimal commas are understood: spreadsheets write
them.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path

from autograder.errors import UsageError
from autograder.gradebook import ClassView, Override, Record, find_record
from autograder.gradebook.record import response_digest
from autograder.reports.whole_files import defused, write_csv

HEADER = (
    *("student", "name", "question", "title", "points", "of", "comment"),
    *("grader_points", "status", "why_open", "author", "response"),
)
_LONGEST_RESPONSE = 30_000  # a cell of a spreadsheet holds 32,767 characters


def write_spreadsheet(path: Path, view: ClassView, everything: bool = False) -> int:
    """Write the rows that a person decided or has to decide; returns how many there are."""
    rows: list[list[object]] = [list(HEADER)]
    for question in view.course.questions.values():
        for record in view.records:
            mark = record.marks.get(question.id)
            override = record.overrides.get(question.id)
            why = record.open_reason(question.id)
            if mark is None or not (everything or why or override):
                continue
            points = None if why or override is None else override.points
            row: list[object] = [record.student, record.name, question.id, question.title]
            row += [points, question.points, override.reason if override else ""]
            row += [mark.points, mark.status, why, override.author if override else ""]
            rows.append([*row, mark.understood[:_LONGEST_RESPONSE]])
    write_csv(path, rows)
    return len(rows) - 1


def read_spreadsheet(path: Path, view: ClassView, author: str) -> list[Override]:
    """What the rows say that differs from the gradebook; an empty cell of points says nothing.

    Raises:
        UsageError: if a row cannot be understood; nothing is taken then.
    """
    found: dict[tuple[str, str], Override] = {}
    now = datetime.now(UTC).isoformat(timespec="seconds")
    for line, row in _rows(path):
        said = row.get("points", "").strip()
        where = f"line {line} of {path}"
        if not said:
            continue
        record, question = _whose(row, view, where)
        points = _points(said, where)
        override = record.overrides.get(question)
        comment = _text(row.get("comment", "")) or (override.reason if override else "")
        if points is not None and not comment:
            comment = "Marked by hand."
        if (record.student, question) in found:
            raise UsageError(f"{where}: {record.name} has two rows for {question}; keep one.")
        mark = record.marks.get(question)
        is_open = mark is not None and mark.status == "recorded"
        response = response_digest(mark) if mark is not None and is_open else ""
        counts = None if record.open_reason(question) or not override else override
        same = counts is not None and (counts.points, counts.reason) == (points, comment)
        if same or (points is None and override is None):
            continue
        by = _text(row.get("author", "")) if override is None else ""
        found[record.student, question] = Override(
            record.student, question, points, comment, now, by or author, {}, response
        )
    return list(found.values())


def _rows(path: Path) -> Iterator[tuple[int, dict[str, str]]]:
    try:
        raw = path.read_bytes()
    except OSError as error:
        raise UsageError(f"{path} cannot be read: {error.strerror or error}.") from None
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = raw.decode("cp1252", "replace")  # a spreadsheet on Windows
    first = text.partition("\n")[0]
    separator = max(",;\t", key=first.count)
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator)
    header = [name.strip().casefold() for name in next(reader, [])]
    for column in ("student", "question", "points"):
        if column not in header:
            raise UsageError(f"{path} has no column {column!r}; write it with --write first.")
    for row in reader:
        if any(cell.strip() for cell in row):
            yield reader.line_num, dict(zip(header, row, strict=False))


def _whose(row: dict[str, str], view: ClassView, where: str) -> tuple[Record, str]:
    try:
        record = find_record(view.records, _text(row.get("student", "")))
        return record, view.course.question(row.get("question", "").strip()).id
    except UsageError as error:
        raise UsageError(f"{where}: {error}") from None


def _points(said: str, where: str) -> float | None:
    if said.casefold() == "none":
        return None
    try:
        points = float(said.replace(",", "."))
    except ValueError:
        points = -1.0
    if not 0 <= points < float("inf"):
        raise UsageError(
            f"{where}: {said!r} is not a number of points; give a number of at least 0, or none."
        )
    return round(points, 2)


def _text(cell: str) -> str:
    """A cell without the apostrophe that keeps a spreadsheet from taking it for a formula."""
    text = cell.strip()
    return text[1:] if text[:1] == "'" and defused(text[1:]) == text else text
