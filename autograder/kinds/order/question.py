"""What is asked: cards to put in order."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from autograder.kinds.question import Question
from autograder.kinds.toml_table import Table


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

    @property
    def texts(self) -> dict[str, str]:
        """The text of each card by its id."""
        return {card.id: card.text for card in self.cards}


def read_question(table: Table, common: dict[str, Any]) -> Order:
    """The question in an author's table."""
    points = table.points()
    cards = table.take("cards", list)
    for card in cards:
        if not (
            isinstance(card, dict)
            and card.keys() == {"id", "text"}
            and all(isinstance(text, str) and text.strip() for text in card.values())
        ):
            raise table.error("each card needs exactly an id and a text")
    read = tuple(Card(card["id"], card["text"]) for card in cards)
    if len({card.id for card in read}) != len(read) or len(read) < 2:
        raise table.error("needs at least two cards, each with an id of its own")
    return Order(**common, points=points, cards=read)
