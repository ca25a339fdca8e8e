"""Statements in a table, each with two radio buttons."""

from __future__ import annotations

from typing import Any

from autograder.course.questions import TrueFalse
from autograder.errors import UsageError
from autograder.student.choices import in_words
from autograder.student.desk import Desk
from autograder.student.widgets.base import source
from autograder.student.widgets.markup import line
from autograder.student.widgets.question import QuestionWidget


class TrueFalseWidget(QuestionWidget):
    """A true/false question."""

    _esm = source("common.js", "question.js", "true_false.js")
    _css = source("common.css", "true_false.css")
    question: TrueFalse

    def __init__(self, desk: Desk, question: TrueFalse, with_prompt: bool = True) -> None:
        super().__init__(desk, question, with_prompt)
        if desk.entry(question).get("attempts"):
            self.remark(lambda: desk.mark_choice(question, count=False))
            self.state = self.what_is_kept()

    def what_is_fixed(self) -> dict[str, Any]:
        statements = [line(statement) for statement in self.question.statements]
        return {**super().what_is_fixed(), "statements": statements}

    def words(self, response: Any) -> str:
        return super().words(None) if response is None else in_words(self.question, response)

    def do_choose(self, message: dict[str, Any]) -> dict[str, Any]:
        """Keep the choice for one statement; the others stay as they are kept, by whomever."""
        at, said = message["statement"], message["said"]
        count = len(self.question.statements)
        if not (isinstance(at, int) and 0 <= at < count and isinstance(said, bool)):
            raise UsageError(f"{self.question.id} has no such statement; run the cell again.")

        def chosen(response: list[bool | None] | None) -> list[bool | None]:
            now = list(response or [None] * count)
            now[at] = said
            return now

        self.desk.keep(self.question, chosen)
        return {}

    def do_check(self, message: dict[str, Any]) -> dict[str, Any]:
        """Mark what is kept and count an attempt."""
        self.show_mark(self.desk.mark_choice(self.question))
        return {}
