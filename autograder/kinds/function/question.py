"""What is asked: a function to write."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from autograder.kinds.question import Question
from autograder.kinds.toml_table import Table


@dataclass(frozen=True)
class Function(Question):
    """A function to write."""

    kind = "function"
    function: str = ""

    @property
    def name(self) -> str | None:
        """The function's name."""
        return self.function


def read_question(table: Table, common: dict[str, Any]) -> Function:
    """The question in an author's table."""
    return Function(**common, points=table.points(), function=table.python_name("function"))
