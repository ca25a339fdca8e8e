"""What is asked: statements to call true or false."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from autograder.kinds.question import Question
from autograder.kinds.toml_table import Table


@dataclass(frozen=True)
class TrueFalse(Question):
    """Statements to call true or false, one point each."""

    kind = "true_false"
    statements: tuple[str, ...] = ()


def read_question(table: Table, common: dict[str, Any]) -> TrueFalse:
    """The question in an author's table."""
    statements = table.some_texts("statements")
    if table.take("points", (int, float), None) is not None:
        raise table.error("a statement is worth one point; remove points")
    return TrueFalse(**common, points=float(len(statements)), statements=statements)
