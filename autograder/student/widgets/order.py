"""Cards to put in order by pointer, touch or keys."""

from __future__ import annotations

from typing import Any

from autograder.course.questions import Order
from autograder.student.choices import in_words, read_choice
from autograder.student.desk import Desk
from autograder.student.widgets.base import source
from autograder.student.widgets.markup import line
from autograder.student.widgets.question import QuestionWidget


class OrderWidget(QuestionWidget):
    """An order question."""

    _esm = source("common.js", "question.js", "order.js")
    _css = source("common.css", "order.css")
    question: Order

    def __init__(self, desk: Desk, question: Order, with_prompt: bool = True) -> None:
        super().__init__(desk, question, with_prompt)
        if desk.entry(question).get("attempts"):
            self.remark(lambda: desk.mark_choice(question, count=False))
            self.state = self.what_is_kept()

    def what_is_fixed(self) -> dict[str, Any]:
        cards = [
            {"id": card.id, "text": card.text, "html": line(card.text)}
            for card in self.question.cards
        ]
        return {**super().what_is_fixed(), "cards": cards}

    def words(self, response: Any) -> str:
        return super().words(None) if response is None else in_words(self.question, response)

    def do_order(self, message: dict[str, Any]) -> dict[str, Any]:
        """Keep the order in which the cards lie now."""
        order = read_choice(self.question, message["cards"])
        self.desk.keep(self.question, lambda before: order)
        return {}

    def do_check(self, message: dict[str, Any]) -> dict[str, Any]:
        """Mark what is kept and count an attempt."""
        self.show_mark(self.desk.mark_choice(self.question))
        return {}
