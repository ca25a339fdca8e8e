"""What is right: formulas, and the points at which a response is compared with them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from autograder.kinds.answer import Alternative, Answer, read_alternative
from autograder.kinds.expression.question import Expression
from autograder.kinds.toml_table import Table


@dataclass(frozen=True)
class ExpressionAlternative(Alternative):
    """A formula, equal up to multiples of ``modulo`` (a formula too) if that is given."""

    expression: str
    modulo: str | None


@dataclass(frozen=True)
class ExpressionAnswer(Answer):
    """The key to an expression question.

    ``sample`` gives each free symbol the range in which hidden points are drawn, ``derived`` the
    formulas of the symbols that follow from them.
    """

    sample: dict[str, tuple[float, float]] = field(hash=False)
    derived: dict[str, str] = field(hash=False)
    free_of: tuple[str, ...]
    free_of_feedback: str


def read_answer(
    question: Expression, table: Table, alternatives: list[Table], common: dict[str, Any]
) -> ExpressionAnswer:
    """The key in an author's table."""
    sample = {name: _range(table, name, ends) for name, ends in table.take("sample", dict).items()}
    derived = dict(table.take("derived", dict, {}))
    if not all(isinstance(formula, str) for formula in derived.values()):
        raise table.error("derived must give each symbol a formula as text")
    free_of = table.texts("free_of", [])
    # What a response must be free of is drawn too, even if the question does not declare it.
    if sample.keys() | derived.keys() != {name for name, _ in question.symbols} | set(free_of):
        raise table.error(
            "sample and derived together must name exactly the question's symbols and "
            "what is in free_of"
        )
    if not set(free_of) <= sample.keys():
        raise table.error("give each symbol of free_of a range in sample")
    known = tuple(
        ExpressionAlternative(
            **read_alternative(entry),
            expression=entry.text("expression"),
            modulo=entry.take("modulo", str, None),
        )
        for entry in alternatives
    )
    return ExpressionAnswer(
        **common,
        alternatives=known,
        sample=sample,
        derived=derived,
        free_of=free_of,
        free_of_feedback=table.text("free_of_feedback", ""),
    )


def _range(table: Table, name: str, ends: Any) -> tuple[float, float]:
    """The ends of the range in which a symbol's values are drawn."""
    numbers = (
        isinstance(ends, list) and len(ends) == 2 and all(type(n) in (int, float) for n in ends)
    )
    if not numbers or not -float("inf") < ends[0] < ends[1] < float("inf"):
        raise table.error(f"sample must give {name!r} two numbers, the smaller one first")
    return float(ends[0]), float(ends[1])
