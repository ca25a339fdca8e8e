"""The key to the questions, read from ``solutions/answers/*.toml``. Never shipped to students."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from autograder import questions as q
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
    """The key to one question; ``code`` fills the solved notebook."""

    id: str
    explanation: str
    code: str
    alternatives: tuple[Any, ...]


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


class _Table:
    """A TOML table whose every field must be known and of the right type."""

    def __init__(self, table: dict[str, Any], where: str) -> None:
        self._table, self._where, self._seen = table, where, set[str]()

    def take(self, key: str, types: Any, default: Any = ...) -> Any:
        self._seen.add(key)
        value = self._table.get(key, default)
        if value is ...:
            raise CourseError(f"{self._where}: the field {key!r} is missing.")
        if value is not default and not isinstance(value, types):
            raise CourseError(f"{self._where}: {key} is {value!r}, which has the wrong type.")
        return value

    def text(self, key: str, default: Any = ...) -> str:
        value = self.take(key, str, default)
        if value == "" and default is ...:
            raise CourseError(f"{self._where}: {key} is empty; write it.")
        return str(value).strip()

    def done(self) -> None:
        unknown = set(self._table) - self._seen
        if unknown:
            raise CourseError(
                f"{self._where}: unknown field {sorted(unknown)[0]!r}; remove or correct it."
            )


def answer_from_table(table: dict[str, Any], question: q.Question) -> Answer:
    """Read the key to one question.

    Raises:
        CourseError: if the table does not fit the question; the sentence says where and why.
    """
    where = f"the answer to {question.id} in solutions/answers/{question.chapter}.toml"
    if not isinstance(table, dict):
        raise CourseError(f"{where} must be a table.")
    read = _Table(table, where)
    common: dict[str, Any] = {
        "id": question.id,
        "explanation": read.text("explanation", ""),
        "code": read.text("code", ""),
    }
    raw_alternatives = read.take("alternative", list, [])
    tables = [
        _Table(entry, f"alternative {entry.get('name', '?')!r} of {where}")
        for entry in raw_alternatives
    ]
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


def _alternative(table: _Table, credit: Any = ...) -> dict[str, Any]:
    fields: dict[str, Any] = {
        "name": table.text("name"),
        "credit": float(table.take("credit", (int, float), credit)),
        "feedback": table.text("feedback", ""),
    }
    if not 0 <= fields["credit"] <= 1:
        raise CourseError(f"{table._where}: credit must be between 0 and 1.")
    return fields


def _true_false(
    question: q.TrueFalse, read: _Table, tables: list[_Table], common: dict[str, Any]
) -> Answer:
    statements = []
    for position, entry in enumerate(read.take("statement", list), 1):
        table = _Table(entry, f"statement {position} of {read._where}")
        statements.append(
            Statement(
                table.take("truth", bool), table.text("explanation"), table.text("misconception")
            )
        )
        table.done()
    if len(statements) != len(question.statements):
        raise CourseError(
            f"{read._where} has {len(statements)} statements, "
            f"but the question asks {len(question.statements)}."
        )
    if tables:
        raise CourseError(f"{read._where}: put what is wrong into each statement's misconception.")
    return TrueFalseAnswer(**common, alternatives=(), statements=tuple(statements))


def _order(question: q.Order, read: _Table, tables: list[_Table], common: dict[str, Any]) -> Answer:
    order = tuple(read.take("order", list))
    if sorted(order) != sorted(question.start):
        raise CourseError(f"{read._where}: order must name every card of the question once.")
    pairs = tuple((str(a), str(b)) for a, b in read.take("before", list))
    groups = tuple(tuple(group) for group in read.take("interchangeable", list, []))
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
        raise CourseError(f"{read._where}: no card has the id {sorted(named - set(order))[0]!r}.")
    for first, second in pairs:
        if order.index(first) >= order.index(second):
            raise CourseError(
                f"{read._where}: the canonical order puts {second!r} before {first!r}."
            )
    return OrderAnswer(
        **common, alternatives=alternatives, order=order, before=pairs, interchangeable=groups
    )


def _number(
    question: q.Number, read: _Table, tables: list[_Table], common: dict[str, Any]
) -> Answer:
    alternatives = tuple(
        NumberAlternative(
            **_alternative(table),
            value=table.take("value", (int, float)),
            tolerance=table.take("tolerance", (int, float), None),
        )
        for table in tables
    )
    return NumberAnswer(**common, alternatives=alternatives)


def _expression(
    question: q.Expression, read: _Table, tables: list[_Table], common: dict[str, Any]
) -> Answer:
    sample = {
        name: (float(low), float(high)) for name, (low, high) in read.take("sample", dict).items()
    }
    derived = dict(read.take("derived", dict, {}))
    if sample.keys() | derived.keys() != {name for name, _ in question.symbols}:
        raise CourseError(
            f"{read._where}: sample and derived together must name exactly the question's symbols."
        )
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
        free_of=tuple(read.take("free_of", list, [])),
        free_of_feedback=read.text("free_of_feedback", ""),
    )


def _function(
    question: q.Function, read: _Table, tables: list[_Table], common: dict[str, Any]
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
