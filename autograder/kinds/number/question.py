"""What is asked: a value."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from autograder.kinds.question import Question
from autograder.kinds.toml_table import Table


@dataclass(frozen=True)
class Number(Question):
    """A value: an integer, or a number that may be rounded to ``decimals`` places."""

    kind = "number"
    variable: str = ""
    integer: bool = False
    decimals: int = 6
    unit: str = ""

    @property
    def name(self) -> str | None:
        """The variable that holds the value."""
        return self.variable

    @property
    def tolerance(self) -> float:
        """How far a value may be from a stated one and still be that value."""
        return 1e-9 if self.integer else 0.5 * 10.0**-self.decimals * (1 + 1e-9)

    def printed(self, value: float) -> str:
        """A value with as many digits as are asked for."""
        return f"{value:.0f}" if self.integer else f"{value:.{self.decimals}f}"


def read_question(table: Table, common: dict[str, Any]) -> Number:
    """The question in an author's table."""
    points = table.points()
    integer = table.take("integer", bool, False)
    decimals = table.take("decimals", int, None)
    if integer == (decimals is not None):
        raise table.error("say either integer = true or decimals = N")
    if decimals is not None and not 0 <= decimals <= 15:
        raise table.error(f"decimals is {decimals}; give a number from 0 to 15")
    return Number(
        **common,
        points=points,
        variable=table.python_name("variable"),
        integer=integer,
        decimals=6 if decimals is None else decimals,
        unit=table.take("unit", str, ""),
    )
