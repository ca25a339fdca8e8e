"""What is asked: a formula in declared symbols."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from autograder.kinds.question import Question
from autograder.kinds.toml_table import Table


@dataclass(frozen=True)
class Expression(Question):
    """A sympy expression in the declared symbols (name -> meaning)."""

    kind = "expression"
    variable: str = ""
    symbols: tuple[tuple[str, str], ...] = ()

    @property
    def name(self) -> str | None:
        """The variable that holds the expression."""
        return self.variable


def read_question(table: Table, common: dict[str, Any]) -> Expression:
    """The question in an author's table."""
    points = table.points()
    symbols = table.take("symbols", dict)
    if not symbols:
        raise table.error("declare at least one symbol")
    for name, meaning in symbols.items():
        table.check_name("a symbol", name)
        if not (isinstance(meaning, str) and meaning.strip()):
            raise table.error(f"say in words what the symbol {name!r} means")
    return Expression(
        **common,
        points=points,
        variable=table.python_name("variable"),
        symbols=tuple(symbols.items()),
    )
