"""Numbers, expressions and functions: what was understood, the mark, and a field to type into."""

from __future__ import annotations

from typing import Any

from autograder.course.questions import Expression, Function, Number, Order, Question, TrueFalse
from autograder.marking.mark import Mark
from autograder.sandbox.inside.evaluate import describe
from autograder.student.desk import Desk
from autograder.student.frontend import running_shell
from autograder.student.responses import Entry
from autograder.student.widgets.base import source
from autograder.student.widgets.markup import formula, line
from autograder.student.widgets.order import OrderWidget
from autograder.student.widgets.question import QuestionWidget
from autograder.student.widgets.true_false import TrueFalseWidget


def question_widget(desk: Desk, question: Question) -> QuestionWidget:
    """The widget of a question of any kind."""
    if isinstance(question, TrueFalse):
        return TrueFalseWidget(desk, question)
    if isinstance(question, Order):
        return OrderWidget(desk, question)
    return ValueWidget(desk, question, ..., None, with_prompt=True)


class ValueWidget(QuestionWidget):
    """A question that a variable or a function of the notebook answers.

    ``value`` is what the notebook gave. Where that is still an ellipsis, a number or an expression
    may be typed into a field instead, and the variable then takes that value.
    """

    _esm = source("common.js", "question.js", "value.js")
    _css = source("common.css", "value.css")

    def __init__(
        self,
        desk: Desk,
        question: Question,
        value: Any,
        mark: Mark | None,
        with_prompt: bool = False,
    ) -> None:
        self.value = value
        self.has_field = value is ... and isinstance(question, Number | Expression)
        super().__init__(desk, question, with_prompt)
        if mark is not None:
            self.show_mark(mark)
        elif desk.entry(question).get("attempts"):
            self.remark(lambda: desk.mark_value(question, ..., count=False))
        if self.has_field:
            _assign(question, desk.typed(question))
        self.state = self.what_is_kept()

    def what_is_fixed(self) -> dict[str, Any]:
        question = self.question
        symbols = question.symbols if isinstance(question, Expression) else ()
        return {
            **super().what_is_fixed(),
            "field": self.has_field,
            "name": question.name,
            "kind": question.kind,
            "unit": question.unit if isinstance(question, Number) else "",
            "symbols": [{"name": name, "meaning": line(meaning)} for name, meaning in symbols]
            if self._with_prompt
            else [],
        }

    def what_is_kept(self) -> dict[str, Any]:
        value = self.desk.typed(self.question) if self.has_field else self.value
        return {**super().what_is_kept(), "understood": self.understood(value)}

    def mark_on_show(self, entry: Entry) -> dict[str, Any] | None:
        shown = super().mark_on_show(entry)
        # The field itself says that nothing was answered.
        return None if shown and self.has_field and shown["status"] == "not attempted" else shown

    def words(self, response: Any) -> str:
        if response is None and self.value is not ...:
            return describe(self.value)
        return super().words(response)

    def understood(self, value: Any) -> str:
        """A value as HTML: numbers with their unit, expressions typeset."""
        if value is ... or isinstance(self.question, Function):
            return ""
        name = f"<code>{self.question.name}</code> ="
        if hasattr(value, "free_symbols"):
            import sympy as sp

            return f"{name} {formula(sp.latex(value))}"
        unit = self.question.unit if isinstance(self.question, Number) else ""
        return f"{name} {line(_plain(describe(value)))} {line(unit)}"

    def do_type(self, message: dict[str, Any]) -> dict[str, Any]:
        """Keep what is typed, as soon as it can be understood."""
        assert isinstance(self.question, Number | Expression)
        value = self.desk.keep_typed(self.question, str(message["text"]))
        _assign(self.question, value)
        return {"understood": self.understood(value)}

    def do_check(self, message: dict[str, Any]) -> dict[str, Any]:
        """Keep and mark what is typed, and count an attempt."""
        reply = self.do_type(message)
        self.show_mark(self.desk.mark_value(self.question, ...))
        return reply


def _assign(question: Question, value: Any) -> None:
    """Give the variable a typed value, so that the cells below can go on with it."""
    shell = running_shell()
    if shell is not None and value is not ...:
        shell.user_ns[question.name] = value


def _plain(text: str) -> str:
    """Text in which Markdown finds nothing to do."""
    return f"`{text}`" if "`" not in text else text
