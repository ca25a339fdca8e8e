"""What a notebook's variable or function holds: how it was understood, its mark, maybe a field."""

from __future__ import annotations

from autograder.course.questions import Question
from autograder.exchange.responses import Entry
from autograder.questions.mark import Mark
from autograder.questions.registry import kind_of
from autograder.reports.markdown import formula, inline
from autograder.sandbox.inside.evaluate import describe
from autograder.student.desk import Desk
from autograder.student.widgets.base import source
from autograder.student.widgets.question import QuestionWidget


class ValueWidget(QuestionWidget):
    """A question that a variable or a function of the notebook answers.

    ``value`` is what the notebook gave, and ``mark`` its mark; without one the question is asked.
    Where the value is still an ellipsis, a response may be typed into a field if the kind has one,
    and the variable then takes that value.
    """

    _esm = source("common.js", "kernel_line.js", "question.js", "value.js")
    _css = source("common.css", "value.css")

    def __init__(
        self,
        desk: Desk,
        question: Question,
        value: object = ...,
        mark: Mark | None = None,
    ) -> None:
        self.value = value
        self.has_field = value is ... and kind_of(question).has_field
        super().__init__(desk, question, with_prompt=mark is None)
        if mark is not None:
            self.show_mark(mark)
        elif desk.entry(question).get("attempts"):
            self.remark(lambda: desk.mark_value(question, ..., count=False))
        if self.has_field:
            desk.assign(question, desk.typed(question))
        self.state = self.what_is_kept()

    def what_is_fixed(self) -> dict[str, object]:
        question = self.question
        return {
            **super().what_is_fixed(),
            "field": self.has_field,
            "name": question.name,
            "unit": "",
            "symbols": [],
        }

    def what_is_kept(self) -> dict[str, object]:
        value = self.desk.typed(self.question) if self.has_field else self.value
        return {**super().what_is_kept(), "understood": self.understood(value)}

    def mark_on_show(self, entry: Entry) -> dict[str, object] | None:
        shown = super().mark_on_show(entry)
        # The field itself says that nothing was answered.
        return None if shown and self.has_field and shown["status"] == "not attempted" else shown

    def words(self, response: object) -> str:
        if response is None and self.value is not ...:
            return describe(self.value)
        return super().words(response)

    def understood(self, value: object) -> str:
        """A value as HTML, expressions typeset."""
        if value is ...:
            return ""
        name = f"<code>{self.question.name}</code> ="
        if hasattr(value, "free_symbols"):
            import sympy as sp

            return f"{name} {formula(sp.latex(value))}"
        return f"{name} {inline(_plain(describe(value)))}"

    def do_type(self, message: dict[str, object]) -> dict[str, object]:
        """Keep what is typed, as soon as it can be understood."""
        value = self.desk.keep_typed(self.question, str(message["text"]))
        self.desk.assign(self.question, value)
        return {"understood": self.understood(value)}

    def do_check(self, message: dict[str, object]) -> dict[str, object]:
        """Keep and mark what is typed, and count an attempt."""
        reply = self.do_type(message)
        self.show_mark(self.desk.mark_value(self.question, ...))
        return reply


def _plain(text: str) -> str:
    """Text in which Markdown finds nothing to do."""
    return f"`{text}`" if "`" not in text else text
