"""What is right: a reference, and whole functions that are wrong in a known way."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from autograder.kinds.answer import Alternative, Answer, read_alternative
from autograder.kinds.toml_table import Table


@dataclass(frozen=True)
class FunctionAlternative(Alternative):
    """A whole wrong function, by its dotted name ``package.module:function``."""

    function: str


@dataclass(frozen=True)
class FunctionAnswer(Answer):
    """The key to a function question; reference, cases, compare and picture are dotted names."""

    reference: str
    cases: str
    compare: str | None
    picture: str | None = None


def read_answer(table: Table, alternatives: list[Table], common: dict[str, Any]) -> FunctionAnswer:
    """The key in an author's table."""
    known = tuple(
        FunctionAlternative(**read_alternative(entry), function=entry.text("function"))
        for entry in alternatives
    )
    return FunctionAnswer(
        **common,
        alternatives=known,
        reference=table.text("reference"),
        cases=table.text("cases"),
        compare=table.take("compare", str, None),
        picture=table.take("picture", str, None),
    )
