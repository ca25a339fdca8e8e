"""What is right: any order that respects the dependencies between the cards."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta, field

from autograder.kinds.order.question import Order
from autograder.questions.answer import Alternative, Answer
from autograder.questions.written import Credit, Text


class OrderAlternative(Alternative, frozen=True, kw_only=True):
    """The card ``first`` standing before the card ``second``, where that shows a known mistake."""

    credit: Credit = 0.0
    first: Text
    second: Text


class OrderAnswer(Answer, frozen=True, kw_only=True):
    """The key to an order question: any order that respects every pair in ``before`` is right."""

    order: tuple[str, ...]
    before: Annotated[
        tuple[tuple[str, str], ...], Meta(description="pairs of cards; the first comes earlier")
    ]
    interchangeable: tuple[tuple[str, ...], ...] = ()
    alternatives: tuple[OrderAlternative, ...] = field(default=(), name="alternative")


def check_order(question: Order, answer: OrderAnswer) -> None:
    """Whether a key speaks of the question's cards, and its own order is right.

    Raises:
        ValueError: if not.
    """
    order, known = answer.order, answer.alternatives
    if sorted(order) != sorted(question.start):
        raise ValueError("order must name every card of the question once")
    named = {name for group in answer.before + answer.interchangeable for name in group}
    named |= {name for entry in known for name in (entry.first, entry.second)}
    if not named <= set(order):
        raise ValueError(f"no card has the id {sorted(named - set(order))[0]!r}")
    for first, second in answer.before:
        if order.index(first) >= order.index(second):
            raise ValueError(f"the canonical order puts {second!r} before {first!r}")
    texts = question.texts
    for group in answer.interchangeable:
        if len({texts[name] for name in group}) > 1:
            raise ValueError(
                f"the cards {', '.join(map(repr, group))} are called interchangeable, "
                "but their texts differ"
            )
