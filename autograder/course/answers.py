"""The key to the questions, read from ``solutions/answers/*.toml``. Never shipped to students."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from autograder.course import questions as q
from autograder.course.toml_table import Table
from autograder.errors import CourseError


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
class NumberAlternative(Alternative):
    """A value, and how far a response may be from it (None: as the question says)."""

    value: float
    tolerance: float | None


@dataclass(frozen=True)
class ExpressionAlternative(Alternative):
    """A formula, equal up to multiples of ``modulo`` (a formula too) if that is given."""

    expression: str
    modulo: str | None


@dataclass(frozen=True)
class OrderAlternative(Alternative):
    """The card ``first`` standing before the card ``second``, where that shows a known mistake."""

    first: str
    second: str


@dataclass(frozen=True)
class FunctionAlternative(Alternative):
    """A whole wrong function, by its dotted name ``package.module:function``."""

    function: str


@dataclass(frozen=True)
class Statement:
    """The truth of one statement, why, and what somebody who says the opposite has in mind."""

    truth: bool
    explanation: str
    misconception: str


@dataclass(frozen=True)
class Answer:
    """The key to one question; ``code`` fills the solved notebook.

    ``snapshot`` says whether a student bundle may check it on examples.
    """

    id: str
    explanation: str
    code: str
    alternatives: tuple[Any, ...]
    snapshot: bool = field(default=True, kw_only=True)


@dataclass(frozen=True)
class TrueFalseAnswer(Answer):
    """The key to a true/false question."""

    statements: tuple[Statement, ...]


@dataclass(frozen=True)
class OrderAnswer(Answer):
    """The key to an order question: any order that respects every pair in ``before`` is right."""

    order: tuple[str, ...]
    before: tuple[tuple[str, str], ...]
    interchangeable: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class NumberAnswer(Answer):
    """The key to a number question."""


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


@dataclass(frozen=True)
class FunctionAnswer(Answer):
    """The key to a function question; reference, cases, compare and picture are dotted names."""

    reference: str
    cases: str
    compare: str | None
    picture: str | None = None


def answer_from_table(table: dict[str, Any], question: q.Question) -> Answer:
    """Read the key to one question.

    Raises:
        CourseError: if the table does not fit the question; the sentence says where and why.
    """
    where = f"the answer to {question.id} in solutions/answers/{question.chapter}.toml"
    if not isinstance(table, dict):
        raise CourseError(f"{where} must be a table.")
    read = Table(table, where)
    common: dict[str, Any] = {
        "id": question.id,
        "explanation": read.text("explanation", ""),
        "code": read.text("code", ""),
        "snapshot": read.take("snapshot", bool, True),
    }
    tables = read.tables("alternative", "alternative", [])
    answer = _READERS[question.kind](question, read, tables, common)
    for entry in (read, *tables):
        entry.done()
    names = [alternative.name for alternative in answer.alternatives]
    if len(set(names)) != len(names):
        raise CourseError(f"{where}: two alternatives have the same name.")
    for alternative in answer.alternatives:
        if alternative.is_mistake and not alternative.feedback:
            raise CourseError(f"{where}: the mistake {alternative.name!r} has no feedback.")
    return answer


def _alternative(table: Table, credit: Any = ...) -> dict[str, Any]:
    fields: dict[str, Any] = {
        "name": table.text("name"),
        "credit": float(table.number("credit", credit)),
        "feedback": table.text("feedback", ""),
    }
    if not 0 <= fields["credit"] <= 1:
        raise table.error("credit must be between 0 and 1")
    return fields


def _true_false(
    question: q.TrueFalse, read: Table, tables: list[Table], common: dict[str, Any]
) -> Answer:
    statements = []
    for table in read.tables("statement", "statement"):
        statements.append(
            Statement(
                table.take("truth", bool), table.text("explanation"), table.text("misconception")
            )
        )
        table.done()
    if len(statements) != len(question.statements):
        raise read.error(
            f"there are {len(statements)} statements, "
            f"but the question asks {len(question.statements)}"
        )
    if tables:
        raise read.error("put what is wrong into each statement's misconception")
    return TrueFalseAnswer(**common, alternatives=(), statements=tuple(statements))


def _order(question: q.Order, read: Table, tables: list[Table], common: dict[str, Any]) -> Answer:
    order = read.texts("order")
    if sorted(order) != sorted(question.start):
        raise read.error("order must name every card of the question once")
    before, groups = read.groups("before"), read.groups("interchangeable", [])
    if any(len(pair) != 2 for pair in before):
        raise read.error("before must be a list of pairs of card ids")
    pairs = tuple((first, second) for first, second in before)
    alternatives = tuple(
        OrderAlternative(
            **_alternative(table, credit=0.0),
            first=table.text("first"),
            second=table.text("second"),
        )
        for table in tables
    )
    named = {name for pair in pairs for name in pair} | {n for group in groups for n in group}
    named |= {name for entry in alternatives for name in (entry.first, entry.second)}
    if not named <= set(order):
        raise read.error(f"no card has the id {sorted(named - set(order))[0]!r}")
    for first, second in pairs:
        if order.index(first) >= order.index(second):
            raise read.error(f"the canonical order puts {second!r} before {first!r}")
    texts = {card.id: card.text for card in question.cards}
    for group in groups:
        if len({texts[name] for name in group}) > 1:
            raise read.error(
                f"the cards {', '.join(map(repr, group))} are called interchangeable, "
                "but their texts differ"
            )
    return OrderAnswer(
        **common, alternatives=alternatives, order=order, before=pairs, interchangeable=groups
    )


def _number(question: q.Number, read: Table, tables: list[Table], common: dict[str, Any]) -> Answer:
    alternatives = tuple(
        NumberAlternative(
            **_alternative(table),
            value=table.number("value"),
            tolerance=table.number("tolerance", None),
        )
        for table in tables
    )
    if any((entry.tolerance or 0) < 0 for entry in alternatives):
        raise read.error("a tolerance is never negative")
    return NumberAnswer(**common, alternatives=alternatives)


def _expression(
    question: q.Expression, read: Table, tables: list[Table], common: dict[str, Any]
) -> Answer:
    sample = {name: _range(read, name, ends) for name, ends in read.take("sample", dict).items()}
    derived = dict(read.take("derived", dict, {}))
    if not all(isinstance(formula, str) for formula in derived.values()):
        raise read.error("derived must give each symbol a formula as text")
    free_of = read.texts("free_of", [])
    # What a response must be free of is drawn too, even if the question does not declare it.
    if sample.keys() | derived.keys() != {name for name, _ in question.symbols} | set(free_of):
        raise read.error(
            "sample and derived together must name exactly the question's symbols and "
            "what is in free_of"
        )
    if not set(free_of) <= sample.keys():
        raise read.error("give each symbol of free_of a range in sample")
    alternatives = tuple(
        ExpressionAlternative(
            **_alternative(table),
            expression=table.text("expression"),
            modulo=table.take("modulo", str, None),
        )
        for table in tables
    )
    return ExpressionAnswer(
        **common,
        alternatives=alternatives,
        sample=sample,
        derived=derived,
        free_of=free_of,
        free_of_feedback=read.text("free_of_feedback", ""),
    )


def _range(read: Table, name: str, ends: Any) -> tuple[float, float]:
    """The ends of the range in which a symbol's values are drawn."""
    numbers = (
        isinstance(ends, list) and len(ends) == 2 and all(type(n) in (int, float) for n in ends)
    )
    if not numbers or not -float("inf") < ends[0] < ends[1] < float("inf"):
        raise read.error(f"sample must give {name!r} two numbers, the smaller one first")
    return float(ends[0]), float(ends[1])


def _function(
    question: q.Function, read: Table, tables: list[Table], common: dict[str, Any]
) -> Answer:
    alternatives = tuple(
        FunctionAlternative(**_alternative(table), function=table.text("function"))
        for table in tables
    )
    return FunctionAnswer(
        **common,
        alternatives=alternatives,
        reference=read.text("reference"),
        cases=read.text("cases"),
        compare=read.take("compare", str, None),
        picture=read.take("picture", str, None),
    )


_READERS: dict[str, Callable[..., Answer]] = {
    "true_false": _true_false,
    "order": _order,
    "number": _number,
    "expression": _expression,
    "function": _function,
}
