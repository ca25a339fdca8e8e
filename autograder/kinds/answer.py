"""What every answer has, whatever its kind. Answers are never shipped to students."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from autograder.kinds.toml_table import Table


@dataclass(frozen=True)
class Alternative:
    """One recognisable response, right or wrong, with its credit from 0 to 1 and its feedback."""

    name: str
    credit: float
    feedback: str

    @property
    def is_mistake(self) -> bool:
        """Whether the response is wrong, or not quite right, in a known way."""
        return self.credit < 1


@dataclass(frozen=True)
class Equivalent:
    """A mutant of what is right that no input can tell from it, and why."""

    mutant: str
    why: str


@dataclass(frozen=True)
class Answer:
    """The key to one question; ``code`` fills the solved notebook.

    ``snapshot`` says whether a student bundle may check it on examples. ``equivalent`` are the
    mutants that need not lose any credit.
    """

    id: str
    explanation: str
    code: str
    alternatives: tuple[Any, ...]
    snapshot: bool = field(default=True, kw_only=True)
    equivalent: tuple[Equivalent, ...] = field(default=(), kw_only=True)


def read_alternative(table: Table, credit: Any = ...) -> dict[str, Any]:
    """The fields that every alternative has, from its table.

    Raises:
        CourseError: if one is missing or wrong.
    """
    fields: dict[str, Any] = {
        "name": table.text("name"),
        "credit": float(table.number("credit", credit)),
        "feedback": table.text("feedback", ""),
    }
    if not 0 <= fields["credit"] <= 1:
        raise table.error("credit must be between 0 and 1")
    return fields
