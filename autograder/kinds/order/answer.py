"""What is right: any order that respects the dependencies between the cards."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from typing import Annotated

from msgspec import Meta, field

from autograder.kinds.order.question import Order
from autograder.questions.answer import Alternative, Answer
from autograder.questions.author_tables import Credit, FieldError, Text


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


def alike(question: Order, answer: OrderAnswer) -> Iterator[tuple[str, str]]:
    """Each two cards with one text that the key does not call interchangeable."""
    texts = {id: " ".join(text.split()) for id, text in question.texts.items()}
    for one, other in combinations(texts, 2):
        together = any({one, other} <= {*group} for group in answer.interchangeable)
        if texts[one] == texts[other] and not together:
            yield one, other


def check_order(question: Order, answer: OrderAnswer) -> None:
    """Whether a key speaks of the question's cards, and its own order is right.

    Raises:
        ValueError: if not.
    """
    order = answer.order
    if sorted(order) != sorted(question.start):
        raise FieldError("order must name every card of the question once", "order")
    for written, groups in (
        ("before", answer.before),
        ("interchangeable", answer.interchangeable),
        ("alternative", [(entry.first, entry.second) for entry in answer.alternatives]),
    ):
        for position, group in enumerate(groups):
            if unknown := sorted({*group} - {*order}):
                raise FieldError(f"no card has the id {unknown[0]!r}", written, position)
    for position, (first, second) in enumerate(answer.before):
        if order.index(first) >= order.index(second):
            raise FieldError(
                f"the canonical order puts {second!r} before {first!r}", "before", position
            )
    texts = question.texts
    for position, group in enumerate(answer.interchangeable):
        if len({texts[name] for name in group}) > 1:
            raise FieldError(
                f"the cards {', '.join(map(repr, group))} are called interchangeable, "
                "but their texts differ",
                "interchangeable",
                position,
            )
