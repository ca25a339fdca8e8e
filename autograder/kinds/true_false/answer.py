"""What is right: the truth of each statement, and why."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from autograder.kinds.answer import Answer
from autograder.kinds.toml_table import Table
from autograder.kinds.true_false.question import TrueFalse


@dataclass(frozen=True)
class Statement:
    """The truth of one statement, why, and what somebody who says the opposite has in mind."""

    truth: bool
    explanation: str
    misconception: str


@dataclass(frozen=True)
class TrueFalseAnswer(Answer):
    """The key to a true/false question."""

    statements: tuple[Statement, ...]


def read_answer(
    question: TrueFalse, table: Table, alternatives: list[Table], common: dict[str, Any]
) -> TrueFalseAnswer:
    """The key in an author's table."""
    statements = []
    for entry in table.tables("statement", "statement"):
        statements.append(
            Statement(
                entry.take("truth", bool), entry.text("explanation"), entry.text("misconception")
            )
        )
        entry.done()
    if len(statements) != len(question.statements):
        raise table.error(
            f"there are {len(statements)} statements, "
            f"but the question asks {len(question.statements)}"
        )
    if alternatives:
        raise table.error("put what is wrong into each statement's misconception")
    return TrueFalseAnswer(**common, alternatives=(), statements=tuple(statements))
