"""Order, as the engine sees it."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator
from typing import TYPE_CHECKING

from autograder.kinds.order import response as given
from autograder.kinds.order.answer import OrderAnswer, alike, check_order
from autograder.kinds.order.marking import is_right, mark_order, transitive_closure
from autograder.kinds.order.question import Order
from autograder.language import N_
from autograder.questions.choice_kinds import ChoiceKind
from autograder.questions.mark import Mark

if TYPE_CHECKING:
    from autograder.kinds.order.widget import OrderWidget
    from autograder.student.desk import Desk


class OrderKind(ChoiceKind[Order, OrderAnswer]):
    """Cards to put in order."""

    name = "order"
    parts_heading = N_("Cards")
    drawn_fields = ("cards", "")
    question_type = Order
    answer_type = OrderAnswer

    def check_answer(self, question: Order, answer: OrderAnswer) -> None:
        check_order(question, answer)

    def poor_draw(self, question: Order, answer: OrderAnswer) -> Iterator[str]:
        if is_right(question.start, answer):
            yield "its cards are dealt in a right order; deal them otherwise."

    def fits(self, question: Order, response: object) -> bool:
        return given.fits(question, response)

    def is_untouched(self, question: Order, response: object) -> bool:
        return tuple(given.chosen(question, response) or ()) == question.start

    def read_response(self, question: Order, response: object) -> object:
        return given.read_response(question, response)

    def in_words(self, question: Order, response: object) -> str:
        return given.in_words(question, given.chosen(question, response) or [])

    def mark_choice(self, question: Order, answer: OrderAnswer, response: object) -> Mark:
        return mark_order(question, answer, response)

    def lines(self, question: Order, response: object) -> list[str]:
        return given.lines(question, given.chosen(question, response) or [])

    def respond_line(self, question: Order, response: object) -> str:
        return given.respond_line(question, given.chosen(question, response))

    def right_in_words(self, question: Order, answer: OrderAnswer) -> list[str]:
        texts = {card.id: card.text for card in question.cards}
        return [f"{place}. {texts[id]}" for place, id in enumerate(answer.order, 1)]

    def widget(
        self, desk: Desk, question: Order, value: object = ..., mark: Mark | None = None
    ) -> OrderWidget:
        from autograder.kinds.order.widget import OrderWidget

        return OrderWidget(desk, question)

    def read_as(self, question: Order, mark: Mark) -> list[str]:
        return mark.understood.split(" › ")

    def other_mistakes(self, question: Order, mark: Mark) -> list[str]:
        return []  # every wrong order has its own cards out of place

    def solution(self, answer: OrderAnswer) -> str:
        rows = textwrap.wrap(", ".join(f'"{card}"' for card in answer.order), 92)
        return "\n".join(["[", *(f"    {row}" for row in rows), "]"])

    def problems(self, question: Order, answer: OrderAnswer) -> Iterator[str]:
        after = transitive_closure(answer.before)
        if not any(
            earlier in after.get(later, ())
            for position, later in enumerate(question.start)
            for earlier in question.start[:position]
        ):
            yield "the cards are dealt in a right order; shuffle them."
        for one, other in alike(question, answer):
            yield (
                f"the cards {one!r} and {other!r} have the same text, so students cannot tell them "
                f'apart; write interchangeable = [["{one}", "{other}"]], or other words.'
            )
        for entry in answer.alternatives:
            if entry.first not in after.get(entry.second, ()):
                yield (
                    f"the mistake {entry.name!r} is none: "
                    f"{entry.first!r} may stand before {entry.second!r}."
                )


KIND = OrderKind()
