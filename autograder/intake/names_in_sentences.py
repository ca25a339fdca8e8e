"""Names of files from a student, fit for a sentence: short, few, without control characters."""

from __future__ import annotations

from pathlib import PurePosixPath

from autograder.exchange.printable import printable

MOST_NAMES = 4  # in one sentence


def shown_path(path: PurePosixPath) -> str:
    """As `shown`, of a path in a submission."""
    return shown(str(path))


def shown(name: str) -> str:
    """A path from a student, fit for a sentence: its end, if it is long."""
    clean = printable(name, "?")
    return clean if len(clean) <= 80 else "…" + clean[-79:]
