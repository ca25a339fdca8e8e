"""A table of times that an instructor gives, by whatever it calls a student: ``times.csv``."""

from __future__ import annotations

from datetime import datetime, tzinfo
from pathlib import Path

from autograder.errors import CourseError
from autograder.intake.spreadsheets import column, read_rows, read_text
from autograder.intake.time_spellings import read_time

_WHO = ("student", "submission", "login", "email", "email address", "sid", "id", "name", "file",
        "username", "prefix", "path", "user")  # fmt: skip
_WHEN = ("time", "handed in", "submitted", "submitted at", "submission time", "date", "timestamp",
         "when", "created at", "last modified (submission)")  # fmt: skip


def read_times(path: Path, zone: tzinfo | None) -> dict[str, datetime]:
    """Times by what the first column calls a student: key, file, name, login, e-mail address or id.

    Raises:
        CourseError: if it cannot be read or a time in it cannot.
    """
    rows = read_rows(read_text(path))
    if not rows:
        return {}
    who, when = column(rows[0], *_WHO), column(rows[0], *_WHEN)
    everybody = [n for n, cell in enumerate(rows[0]) if column([cell], *_WHO) is not None]
    if when is None:
        who, when, everybody = 0, 1, [0]
    else:
        rows = rows[1:]
    if who is None:
        raise CourseError(f"{path} has no column that says whose a time is; name one student.")
    times: dict[str, datetime] = {}
    for row in rows:
        text = row[when] if when < len(row) else ""
        if not text or text == "-":
            continue
        time = read_time(text, zone)
        if time is None:
            raise CourseError(f"{path}: {text!r} is not a time; write 2026-11-20T23:59:00+01:00.")
        for index in everybody:
            if index < len(row) and row[index]:
                times[row[index].casefold()] = time
    return times
