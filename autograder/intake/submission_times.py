"""When something was handed in, and whether the times can be believed.

In this order: a time in the class list, the layout's own, ``times.csv``, what `submit()` wrote into
the zip (a hint: students can change it), and the file's own time only when that is asked for, since
a download sets it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta, tzinfo
from pathlib import Path

from autograder.errors import CourseError
from autograder.intake.long_list import LongList
from autograder.intake.spreadsheets import column, read_rows, read_text

_MONTHS = {
    name: number
    for names in (
        "january february march april may june july august september october november december",
        "januar februar märz april mai juni juli august september oktober november dezember",
        "janvier février mars avril mai juin juillet août septembre octobre novembre décembre",
        "enero febrero marzo abril mayo junio julio agosto septiembre octubre noviembre diciembre",
        "gennaio febbraio marzo aprile maggio giugno luglio agosto settembre ottobre novembre "
        "dicembre",
        "janeiro fevereiro março abril maio junho julho agosto setembro outubro novembro dezembro",
        "januari februari maart april mei juni juli augustus september oktober november december",
        "jan feb mar apr may jun jul aug sep oct nov dec",
    )
    for number, name in enumerate(names.split(), 1)
}
_WRITTEN = re.compile(
    r"(?:(?P<day>\d{1,2})\.?\s+(?:de\s+)?(?P<month>[^\W\d]{3,})|(?P<month2>[^\W\d]{3,})\s+(?P<day2>\d{1,2}))"
    r"\.?,?\s+(?:de\s+)?(?P<year>\d{4}),?\s+(?:at\s+|um\s+|à\s+)?"
    r"(?P<hour>\d{1,2})[:h.](?P<minute>\d\d)(?::(?P<second>\d\d))?\s*(?P<half>[ap]\.?m\.?)?",
    re.IGNORECASE,
)
_NUMERIC = re.compile(
    r"(?P<day>\d{1,2})\.(?P<month>\d{1,2})\.(?P<year>\d{4}),?\s+"
    r"(?P<hour>\d{1,2}):(?P<minute>\d\d)(?::(?P<second>\d\d))?"
)
_WHO = ("student", "submission", "login", "email", "email address", "sid", "id", "name", "file",
        "username", "prefix", "path", "user")  # fmt: skip
_WHEN = ("time", "handed in", "submitted", "submitted at", "submission time", "date", "timestamp",
         "when", "created at", "last modified (submission)")  # fmt: skip
_TOGETHER = timedelta(minutes=10)
_FEWEST = 3  # of whom times can look alike


def read_time(text: str, zone: tzinfo | None) -> datetime | None:
    """A time as people and systems write it; without a zone it is in ``zone`` or this machine's.

    ISO 8601, ``1.11.2026 12:30``, and Moodle's ``Sunday, 1 November 2026, 12:30 PM``. Dates of
    numbers and slashes are not read: they mean two things.
    """
    text = " ".join(text.split())
    if not text or text == "-":
        return None
    try:
        return _with_zone(datetime.fromisoformat(re.sub(r" ?(UTC|GMT)$", "+00:00", text)), zone)
    except ValueError:
        pass
    spaced = re.fullmatch(r"(\d{4}-\d\d-\d\d \d\d:\d\d(?::\d\d(?:\.\d+)?)?) ([+-]\d\d:?\d\d)", text)
    if spaced:
        try:
            return _with_zone(datetime.fromisoformat(spaced[1] + spaced[2]), zone)
        except ValueError:
            return None
    found = _WRITTEN.search(text)
    numeric = None if found else _NUMERIC.search(text)
    if found is None and numeric is None:
        return None
    try:
        if found is not None:
            month = _MONTHS[(found["month"] or found["month2"]).casefold()]
            day, half = int(found["day"] or found["day2"]), (found["half"] or "").lower()
            hour = int(found["hour"])
            if half:
                hour = hour % 12 + (12 if half[0] == "p" else 0)
            parts = found
        else:
            assert numeric is not None
            parts, month, day, hour = (
                numeric,
                int(numeric["month"]),
                int(numeric["day"]),
                int(numeric["hour"]),
            )
        second = int(parts["second"] or 0)
        time = datetime(int(parts["year"]), month, day, hour, int(parts["minute"]), second)
        return _with_zone(time, zone)
    except (KeyError, ValueError):
        return None


def _with_zone(time: datetime, zone: tzinfo | None) -> datetime:
    if time.tzinfo is not None:
        return time
    return time.astimezone(UTC) if zone is None else time.replace(tzinfo=zone)


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


@dataclass(frozen=True)
class Doubt:
    """Why the times should be looked at before anybody loses points; empty if they need not be."""

    sentence: str = ""

    def __bool__(self) -> bool:
        return bool(self.sentence)


def doubt(times: Sequence[tuple[datetime, bool]]) -> Doubt:
    """Whether times (each with whether it is late) look like a download's or a wrong zone's."""
    if len(times) < _FEWEST:
        return Doubt()
    span = max(time for time, _ in times) - min(time for time, _ in times)
    if span <= _TOGETHER:
        minutes = max(1, round(span.total_seconds() / 60))
        return Doubt(
            f"All {len(times)} times lie within {minutes} minutes of each other, as after a "
            "download; no penalty is taken. Give --times FILE, or --trust-times if they are right."
        )
    if all(late for _, late in times):
        return Doubt(
            f"All {len(times)} with a known time are late; no penalty is taken. Check the due time "
            "and its zone, then say --trust-times if it is so."
        )
    return Doubt()


def snapshot(paths: Sequence[Path]) -> dict[Path, tuple[int, int]]:
    """Size and time of every file at the paths, to see later whether anything was changed."""
    seen: dict[Path, tuple[int, int]] = {}
    for path in dict.fromkeys(paths):
        files = [path]
        if path.is_dir() and not path.is_symlink():
            files = [file for file in path.rglob("*") if file.is_file() and not file.is_symlink()]
        for file in files:
            try:
                status = file.lstat()
            except OSError:
                continue
            seen[file] = (status.st_size, status.st_mtime_ns)
    return seen


def snapshot_class(paths: Iterable[Path]) -> LongList[tuple[Path, tuple[int, int]]]:
    """As `snapshot`, for the places of a class of any size: each file with its size and time."""
    seen: LongList[tuple[Path, tuple[int, int]]] = LongList(tuple[Path, tuple[int, int]])
    last = None
    for path in paths:
        if path != last:  # what lies in one zip follows each other
            seen += snapshot([path]).items()
        last = path
    return seen


def changed_since(before: Iterable[tuple[Path, tuple[int, int]]]) -> list[Path]:
    """The files that are no longer as they were."""
    return [path for path, status in before if snapshot([path]).get(path) != status]
