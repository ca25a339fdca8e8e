"""How an order of cards is understood and shown."""

from __future__ import annotations

from typing import Any

from autograder.errors import UsageError
from autograder.kinds.order.question import Order


def fits(question: Order, response: object) -> bool:
    """Whether the response is a list that names every card exactly once."""
    return (
        isinstance(response, list | tuple)
        and all(isinstance(card, str) for card in response)
        and sorted(response) == sorted(question.start)
    )


def read_response(question: Order, response: Any) -> list[str]:
    """A response given in code, by the cards' ids or their numbers, as it is kept: by ids.

    Raises:
        UsageError: if it does not fit the question.
    """
    if isinstance(response, list | tuple) and all(
        isinstance(n, int) and not isinstance(n, bool) and 1 <= n <= len(question.cards)
        for n in response
    ):
        response = [question.start[n - 1] for n in response]
    if not fits(question, response):
        raise UsageError(
            f"{question.id} has {len(question.cards)} cards: respond with a list that names each "
            "card once, by the number or the id shown beside it. Nothing was changed."
        )
    return list(response)


def in_words(question: Order, response: list[str]) -> str:
    """A kept response in one line."""
    return " › ".join(question.texts[card] for card in response)


def lines(question: Order, response: list[str] | None) -> list[str]:
    """The cards and the order so far, as Markdown."""
    cards = [f"{n}. {card.text} (`{card.id}`)" for n, card in enumerate(question.cards, 1)]
    if response:
        cards += ["", "Your order: " + in_words(question, response)]
    return [
        *cards,
        "",
        f'Answer with `ask("{question.id}").respond([...])`: '
        "the cards' numbers, in the order you want.",
    ]
