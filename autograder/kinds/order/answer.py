"""What is right: any order that respects the dependencies between the cards."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from autograder.kinds.answer import Alternative, Answer, read_alternative
from autograder.kinds.order.question import Order
from autograder.kinds.toml_table import Table


@dataclass(frozen=True)
class OrderAlternative(Alternative):
    """The card ``first`` standing before the card ``second``, where that shows a known mistake."""

    first: str
    second: str


@dataclass(frozen=True)
class OrderAnswer(Answer):
    """The key to an order question: any order that respects every pair in ``before`` is right."""

    order: tuple[str, ...]
    before: tuple[tuple[str, str], ...]
    interchangeable: tuple[tuple[str, ...], ...]


def read_answer(
    question: Order, table: Table, alternatives: list[Table], common: dict[str, Any]
) -> OrderAnswer:
    """The key in an author's table."""
    order = table.texts("order")
    if sorted(order) != sorted(question.start):
        raise table.error("order must name every card of the question once")
    before, groups = table.groups("before"), table.groups("interchangeable", [])
    if any(len(pair) != 2 for pair in before):
        raise table.error("before must be a list of pairs of card ids")
    pairs = tuple((first, second) for first, second in before)
    known = tuple(
        OrderAlternative(
            **read_alternative(entry, credit=0.0),
            first=entry.text("first"),
            second=entry.text("second"),
        )
        for entry in alternatives
    )
    named = {name for pair in pairs for name in pair} | {n for group in groups for n in group}
    named |= {name for entry in known for name in (entry.first, entry.second)}
    if not named <= set(order):
        raise table.error(f"no card has the id {sorted(named - set(order))[0]!r}")
    for first, second in pairs:
        if order.index(first) >= order.index(second):
            raise table.error(f"the canonical order puts {second!r} before {first!r}")
    texts = question.texts
    for group in groups:
        if len({texts[name] for name in group}) > 1:
            raise table.error(
                f"the cards {', '.join(map(repr, group))} are called interchangeable, "
                "but their texts differ"
            )
    return OrderAnswer(
        **common, alternatives=known, order=order, before=pairs, interchangeable=groups
    )
