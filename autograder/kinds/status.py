"""The nine statuses of a mark, each with its sign, its words and its colour in one table."""

from __future__ import annotations

from enum import StrEnum
from typing import NamedTuple


class Status(StrEnum):
    """How the marking of a response ended."""

    RIGHT = "right"
    PARTIAL = "partial"
    WRONG = "wrong"
    NOT_ATTEMPTED = "not attempted"
    ERROR = "error"  # the student's code raised
    TIMEOUT = "timeout"
    KILLED = "killed"  # memory, a crash, an exit
    UNREADABLE = "unreadable"  # the submission could not be opened
    RECORDED = "recorded"  # no key here to mark it with, or a person will

    @property
    def sign(self) -> str:
        """One character, for tables."""
        return _LOOKS[self].sign

    @property
    def words(self) -> str:
        """What a student reads."""
        return _LOOKS[self].words

    @property
    def color(self) -> str:
        """One of Rich's colors, for the terminal."""
        return _LOOKS[self].color


class _Look(NamedTuple):
    sign: str
    words: str
    color: str


_LOOKS = {
    Status.RIGHT: _Look("✓", "Right", "green"),
    Status.PARTIAL: _Look("◐", "Partly right", "yellow"),
    Status.WRONG: _Look("✗", "Not right yet", "red"),
    Status.NOT_ATTEMPTED: _Look("○", "Not attempted", "dim"),
    Status.ERROR: _Look("E", "Stopped by an exception", "red"),
    Status.TIMEOUT: _Look("T", "Took too long", "red"),
    Status.KILLED: _Look("K", "Ended before it answered", "red"),
    Status.UNREADABLE: _Look("?", "Could not be opened", "red"),
    Status.RECORDED: _Look("●", "Not marked yet", "default"),
}
