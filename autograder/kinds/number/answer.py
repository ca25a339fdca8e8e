"""What is right: known values, right and wrong."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from autograder.kinds.answer import Alternative, Answer, read_alternative
from autograder.kinds.toml_table import Table


@dataclass(frozen=True)
class NumberAlternative(Alternative):
    """A value, and how far a response may be from it (None: as the question says)."""

    value: float
    tolerance: float | None


@dataclass(frozen=True)
class NumberAnswer(Answer):
    """The key to a number question."""


def read_answer(table: Table, alternatives: list[Table], common: dict[str, Any]) -> NumberAnswer:
    """The key in an author's table."""
    known = tuple(
        NumberAlternative(
            **read_alternative(entry),
            value=entry.number("value"),
            tolerance=entry.number("tolerance", None),
        )
        for entry in alternatives
    )
    if any((entry.tolerance or 0) < 0 for entry in known):
        raise table.error("a tolerance is never negative")
    return NumberAnswer(**common, alternatives=known)
