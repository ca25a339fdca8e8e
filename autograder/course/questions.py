"""What is asked: the five kinds of question, read from ``notebooks/questions/*.toml``.

Nothing here knows an answer; these files go to students.
"""

from __future__ import annotations

import keyword
import re
from dataclasses import dataclass
from typing import Any, ClassVar

from autograder.errors import CourseError

_ID = re.compile(r"Q\d+(\.\d+)*[a-z]?\d?")
_NAME = re.compile(r"[A-Za-z_]\w*")


@dataclass(frozen=True)
class Question:
    """One thing asked.

    ``id`` is stable (``Q3.2.1``), ``prompt`` and ``hints`` are Markdown, ``points`` is what a
    right response earns; 0 if it is there for practice only.
    """

    kind: ClassVar[str]

    id: str
    chapter: str
    title: str
    prompt: str
    points: float
    hints: tuple[str, ...]

    @property
    def name(self) -> str | None:
        """The variable or function that holds the response, or None if it is given to ``ask``."""
        return None


@dataclass(frozen=True)
class TrueFalse(Question):
    """Statements to call true or false, one point each."""

    kind = "true_false"
    statements: tuple[str, ...] = ()


@dataclass(frozen=True)
class Card:
    """One step of an order question."""

    id: str
    text: str


@dataclass(frozen=True)
class Order(Question):
    """Cards to put in order; ``cards`` stand in the order in which a student first sees them."""

    kind = "order"
    cards: tuple[Card, ...] = ()

    @property
    def start(self) -> tuple[str, ...]:
        """The untouched order, as card ids."""
        return tuple(card.id for card in self.cards)


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


@dataclass(frozen=True)
class Function(Question):
    """A function to write."""

    kind = "function"
    function: str = ""

    @property
    def name(self) -> str | None:
        """The function's name."""
        return self.function


KINDS: dict[str, type[Question]] = {
    kind.kind: kind for kind in (TrueFalse, Order, Number, Expression, Function)
}
_COMMON = {"id", "kind", "title", "prompt", "points", "hints"}
_OWN = {
    "true_false": {"statements"},
    "order": {"cards"},
    "number": {"variable", "integer", "decimals", "unit"},
    "expression": {"variable", "symbols"},
    "function": {"function"},
}


def question_from_table(table: dict[str, Any], chapter: str) -> Question:
    """Read one ``[[question]]`` table.

    Raises:
        CourseError: if a field is missing, unknown or of the wrong type; the sentence names the
            question, the field and the file.
    """
    where = f"question {table.get('id', '?')!r} in notebooks/questions/{chapter}.toml"
    kind = table.get("kind")
    if not isinstance(kind, str) or kind not in KINDS:
        raise CourseError(f"{where}: kind {kind!r} is not one of {', '.join(KINDS)}.")
    unknown = set(table) - _COMMON - _OWN[kind]
    if unknown:
        raise CourseError(f"{where}: unknown field {sorted(unknown)[0]!r}; remove or correct it.")

    def take(field: str, expected: type | tuple[type, ...], default: Any = ...) -> Any:
        value = table.get(field, default)
        if value is ...:
            raise CourseError(f"{where}: the field {field!r} is missing.")
        # To Python a truth value is an int.
        if not isinstance(value, expected) or (isinstance(value, bool) and expected is not bool):
            raise CourseError(f"{where}: {field} is {value!r}, which has the wrong type.")
        return value

    def take_name(field: str) -> str:
        name = take(field, str)
        check_name(field, name)
        return str(name)

    def check_name(field: str, name: str) -> None:
        if not _NAME.fullmatch(name) or keyword.iskeyword(name):
            raise CourseError(f"{where}: {field} is {name!r}, which is no Python name.")

    def take_texts(field: str) -> tuple[str, ...]:
        texts = take(field, list)
        if not texts:
            raise CourseError(f"{where}: {field} is empty; give at least one.")
        if not all(isinstance(text, str) and text.strip() for text in texts):
            raise CourseError(f"{where}: one of the {field} is empty; write it or remove it.")
        return tuple(texts)

    if not _ID.fullmatch(take("id", str)):
        raise CourseError(f"{where}: an id looks like Q3.2.1 or Q2.2a.")
    for field in ("title", "prompt"):
        if not take(field, str).strip():
            raise CourseError(f"{where}: {field} is empty; write it.")
    common: dict[str, Any] = {
        "id": table["id"],
        "chapter": chapter,
        "title": table["title"].strip(),
        "prompt": table["prompt"].strip(),
        "hints": take_texts("hints"),
    }
    if kind == "true_false":
        statements = take_texts("statements")
        if "points" in table:
            raise CourseError(f"{where}: a statement is worth one point; remove points.")
        return TrueFalse(**common, points=float(len(statements)), statements=statements)

    points = float(take("points", (int, float)))
    if not 0 <= points < float("inf"):
        raise CourseError(f"{where}: points must be a number of at least 0 (0: it is ungraded).")
    common["points"] = points
    if kind == "order":
        cards = take("cards", list)
        for card in cards:
            if not (
                isinstance(card, dict)
                and card.keys() == {"id", "text"}
                and all(isinstance(text, str) and text.strip() for text in card.values())
            ):
                raise CourseError(f"{where}: each card needs exactly an id and a text.")
        read = tuple(Card(card["id"], card["text"]) for card in cards)
        if len({card.id for card in read}) != len(read) or len(read) < 2:
            raise CourseError(f"{where}: needs at least two cards, each with an id of its own.")
        return Order(**common, cards=read)
    if kind == "number":
        integer = take("integer", bool, False)
        if integer == ("decimals" in table):
            raise CourseError(f"{where}: say either integer = true or decimals = N.")
        decimals = take("decimals", int, 6)
        if not 0 <= decimals <= 15:
            raise CourseError(f"{where}: decimals is {decimals}; give a number from 0 to 15.")
        return Number(
            **common,
            variable=take_name("variable"),
            integer=integer,
            decimals=decimals,
            unit=take("unit", str, ""),
        )
    if kind == "expression":
        symbols = take("symbols", dict)
        if not symbols:
            raise CourseError(f"{where}: declare at least one symbol.")
        for name, meaning in symbols.items():
            check_name("a symbol", name)
            if not (isinstance(meaning, str) and meaning.strip()):
                raise CourseError(f"{where}: say in words what the symbol {name!r} means.")
        return Expression(**common, variable=take_name("variable"), symbols=tuple(symbols.items()))
    return Function(**common, function=take_name("function"))
