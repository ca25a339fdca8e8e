"""How an order of cards is understood and shown."""

from __future__ import annotations

from autograder.errors import UsageError
from autograder.kinds.order.question import Order
from autograder.language import _
from autograder.questions.given_entries import given_entries


def chosen(question: Order, response: object) -> list[str] | None:
    """The response, if it is a list that names every card exactly once; else None."""
    if not isinstance(response, list | tuple):
        return None
    if not all(isinstance(card, str) for card in response):
        return None
    return list(response) if sorted(response) == sorted(question.start) else None


def fits(question: Order, response: object) -> bool:
    """Whether it is a response to this question."""
    return chosen(question, response) is not None


def read_response(question: Order, response: object) -> list[str]:
    """A response given in code, by the cards' ids or their numbers, as it is kept: by ids.

    Raises:
        UsageError: if it does not fit the question.
    """
    response = given_entries(response)
    if response is not None and all(
        isinstance(n, int) and not isinstance(n, bool) and 1 <= n <= len(question.cards)
        for n in response
    ):
        response = [question.start[n - 1] for n in response]
    cards = chosen(question, response)
    if cards is None:
        raise UsageError(
            _(
                "{question} has {count} cards: respond with a list that names each card once, by "
                "the number or the id shown beside it. Nothing was changed."
            ).format(question=question.id, count=len(question.cards))
        )
    return cards


def in_words(question: Order, response: list[str]) -> str:
    """A kept response in one line."""
    return " › ".join(question.texts[card] for card in response)


def lines(question: Order, response: list[str] | None) -> list[str]:
    """The cards and the order so far, as Markdown."""
    cards = [f"{n}. {card.text} (`{card.id}`)" for n, card in enumerate(question.cards, 1)]
    if response:
        cards += ["", _("Your order: {order}").format(order=in_words(question, response))]
    return [
        *cards,
        "",
        _("Answer with a line of code: put the cards' numbers in the order you want."),
        "",
        f"`{respond_line(question, response)}`",
    ]


def respond_line(question: Order, response: list[str] | None) -> str:
    """A line of code that gives this order, by the cards' numbers; as dealt, if there is none."""
    numbers = [question.start.index(card) + 1 for card in response or question.start]
    return f'ask("{question.id}").respond({numbers})'
