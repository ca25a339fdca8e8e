"""What is asked: cards to put in order."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta

from autograder.questions.author_tables import FieldError, Text, Written, second_of
from autograder.questions.question import PointedQuestion


class Card(Written, frozen=True):
    """One step of an order question."""

    id: Text
    text: Text


class Order(PointedQuestion, frozen=True, kw_only=True, tag="order"):
    """Cards to put in order; ``cards`` stand in the order in which a student first sees them."""

    kind = "order"
    cards: Annotated[tuple[Card, ...], Meta(min_length=2)]
    draws: Annotated[
        tuple[tuple[int, ...], ...],
        Meta(description="orders in which the cards may be dealt, by number; the sheet's first"),
    ] = ()

    def __post_init__(self) -> None:
        super().__post_init__()
        if (twice := second_of(self.start)) is not None:
            raise FieldError("two cards have the same id; rename one", "cards", twice)

    @property
    def start(self) -> tuple[str, ...]:
        """The untouched order, as card ids."""
        return tuple(card.id for card in self.cards)

    @property
    def texts(self) -> dict[str, str]:
        """The text of each card by its id."""
        return {card.id: card.text for card in self.cards}
