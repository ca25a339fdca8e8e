"""Responses that are data rather than code: what fits a question, and what is still untouched."""

from __future__ import annotations

import math
from typing import Any

from autograder.course.questions import Expression, Number, Order, Question, TrueFalse
from autograder.errors import UsageError
from autograder.kinds.order.marking import fits_order
from autograder.kinds.true_false.marking import fits_true_false


def fits(question: Question, response: Any) -> bool:
    """Whether a stored response is one that this question can have.

    A stored number or formula is what was typed into a field.
    """
    if isinstance(question, TrueFalse):
        return fits_true_false(question, response)
    if isinstance(question, Order):
        return fits_order(question, response)
    if isinstance(question, Number):
        return (
            isinstance(response, int | float)
            and not isinstance(response, bool)
            and math.isfinite(response)
        )
    return isinstance(question, Expression) and isinstance(response, str)


def untouched(question: Question, response: Any) -> bool:
    """Whether every statement is still open, or the cards lie as they were dealt."""
    if isinstance(question, TrueFalse):
        return all(said is None for said in response)
    if isinstance(question, Order):
        return tuple(response) == question.start
    return False


def read_choice(question: TrueFalse | Order, response: Any) -> list[Any]:
    """A response given in code, in the form in which it is kept.

    Raises:
        UsageError: if it does not fit the question.
    """
    response = list(response) if isinstance(response, list | tuple) else response
    if isinstance(question, TrueFalse):
        if not fits_true_false(question, response):
            count = len(question.statements)
            raise UsageError(
                f"{question.id} has {count} statements: respond with a list of {count} True or "
                "False (None leaves one open). Nothing was changed."
            )
        return list(response)
    if isinstance(response, list) and all(
        isinstance(n, int) and not isinstance(n, bool) and 1 <= n <= len(question.cards)
        for n in response
    ):
        response = [question.start[n - 1] for n in response]
    if not fits_order(question, response):
        raise UsageError(
            f"{question.id} has {len(question.cards)} cards: respond with a list that names each "
            "card once, by the number or the id shown beside it. Nothing was changed."
        )
    return list(response)


def in_words(question: Question, response: Any) -> str:
    """A response for people to read, in one line."""
    if isinstance(question, TrueFalse):
        words = {True: "true", False: "false", None: "open"}
        return " · ".join(f"{n} {words[said]}" for n, said in enumerate(response, 1))
    if isinstance(question, Order):
        texts = {card.id: card.text for card in question.cards}
        return " › ".join(texts[card] for card in response)
    return str(response)
