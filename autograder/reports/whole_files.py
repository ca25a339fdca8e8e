"""Writing reports: whole or not at all, under names that every file system takes."""

from __future__ import annotations

import csv
import hashlib
import os
import re
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from autograder.errors import machine_error
from autograder.exchange.printable import printable

_RESERVED = {"con", "prn", "aux", "nul"} | {f"{d}{n}" for d in ("com", "lpt") for n in range(10)}
_LONGEST = 120  # bytes


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """A path to write to, which takes the place of ``path`` once all of it was written.

    Raises:
        MachineError: if there is no room, or no right to write there.
    """
    unfinished = path.with_name(path.name + ".tmp")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        unfinished.unlink(missing_ok=True)  # it may be a link that somebody has put there
        try:
            yield unfinished
            os.replace(unfinished, path)
        finally:
            unfinished.unlink(missing_ok=True)
    except OSError as error:
        raise machine_error(error, str(path)) or error from None


def write_text(path: Path, text: str) -> None:
    """Write a file; whoever reads it meanwhile sees the old one or the new one."""
    with replacing(path) as unfinished:
        unfinished.write_text(text, encoding="utf-8", errors="replace", newline="")


def write_csv(path: Path, rows: Iterable[Sequence[object]]) -> None:
    """Write a table; no cell of text is taken for a formula by a spreadsheet."""
    with (
        replacing(path) as unfinished,
        unfinished.open("w", newline="", encoding="utf-8", errors="replace") as file,
    ):
        writer = csv.writer(file)
        for row in rows:
            writer.writerow([cell(value) for value in row])


def cell(value: object) -> str:
    """A value as a CSV cell: numbers as they are, text defused, nothing for None."""
    if value is None:
        return ""
    if isinstance(value, bool | str):
        return defused(str(value))
    if isinstance(value, int | float):
        return f"{value:g}" if abs(value) < 1e6 else repr(value)
    return defused(str(value))


def defused(text: str) -> str:
    """Text that no spreadsheet takes for a formula, on one line and without control characters."""
    text = printable(text, " ")
    return "'" + text if text.lstrip()[:1] in tuple("=+-@＝＋－＠|%") else text


def file_name(student: str) -> str:
    """A file name for a student, different for different students."""
    plain = re.sub(r'[<>:"/\\|?*\x00-\x1f\x7f]', "_", student).strip(" .")
    fits = len(plain.encode("utf-8", "replace")) <= _LONGEST
    if plain and plain == student and fits and plain.casefold() not in _RESERVED:
        return plain
    digest = hashlib.sha256(student.encode("utf-8", "replace")).hexdigest()[:8]
    shortened = plain.encode("utf-8", "replace")[:_LONGEST].decode("utf-8", "ignore")
    return f"{shortened.strip(' .') or 'student'}-{digest}"
