"""Cards to put in order by pointer, touch or keys."""

from __future__ import annotations

from pathlib import Path

from autograder.kinds.order.question import Order
from autograder.kinds.order.response import read_response
from autograder.reports.markdown import inline
from autograder.student.widgets.base import source
from autograder.student.widgets.choice import ChoiceWidget

HERE = Path(__file__).parent


class OrderWidget(ChoiceWidget):
    """An order question."""

    _esm = source("common.js", "kernel_line.js", "question.js", HERE / "widget.js")
    _css = source("common.css", HERE / "widget.css")
    question: Order

    def what_is_fixed(self) -> dict[str, object]:
        cards = [
            {"id": card.id, "text": card.text, "html": inline(card.text)}
            for card in self.question.cards
        ]
        return {**super().what_is_fixed(), "cards": cards}

    def do_order(self, message: dict[str, object]) -> dict[str, object]:
        """Keep the order in which the cards lie now."""
        order = read_response(self.question, message["cards"])
        self.desk.keep(self.question, lambda before: order)
        return {}
