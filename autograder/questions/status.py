"""The nine statuses of a mark, each with its sign, its words and its colour in one table."""

from __future__ import annotations

from enum import StrEnum
from typing import NamedTuple

from autograder.language import N_, _


class Status(StrEnum):
    """How the marking of a response ended."""

    RIGHT = N_("right")
    PARTIAL = N_("partial")
    WRONG = N_("wrong")
    NOT_ATTEMPTED = N_("not attempted")
    ERROR = N_("error")  # the student's code raised
    TIMEOUT = N_("timeout")
    KILLED = N_("killed")  # memory, a crash, an exit
    UNREADABLE = N_("unreadable")  # the submission could not be opened
    RECORDED = N_("recorded")  # no key here to mark it with, or a person will

    @property
    def sign(self) -> str:
        """One character, for tables."""
        return _LOOKS[self].sign

    @property
    def words(self) -> str:
        """What a student reads."""
        return _(_LOOKS[self].words)

    @property
    def plain(self) -> str:
        """Its name in the language that is spoken."""
        return _(self.value)

    @property
    def color(self) -> str:
        """One of Rich's colors, for the terminal."""
        return _LOOKS[self].color


class _Look(NamedTuple):
    sign: str
    words: str
    color: str


_LOOKS = {
    Status.RIGHT: _Look("✓", N_("Right"), "green"),
    Status.PARTIAL: _Look("◐", N_("Partly right"), "yellow"),
    Status.WRONG: _Look("✗", N_("Not right yet"), "red"),
    Status.NOT_ATTEMPTED: _Look("○", N_("Not attempted"), "dim"),
    Status.ERROR: _Look("E", N_("Stopped by an exception"), "red"),
    Status.TIMEOUT: _Look("T", N_("Took too long"), "red"),
    Status.KILLED: _Look("K", N_("Ended before it answered"), "red"),
    Status.UNREADABLE: _Look("?", N_("Could not be opened"), "red"),
    Status.RECORDED: _Look("●", N_("Not marked yet"), "default"),
}
