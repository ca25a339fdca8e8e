"""What the widgets have in common whose responses are kept as they are clicked."""

from __future__ import annotations

from autograder.questions.question import Question
from autograder.questions.registry import kind_of
from autograder.student.desk import Desk
from autograder.student.widgets.question import QuestionWidget


class ChoiceWidget(QuestionWidget):
    """A question that is answered in the widget; what is kept is marked at a click."""

    def __init__(self, desk: Desk, question: Question, with_prompt: bool = True) -> None:
        super().__init__(desk, question, with_prompt)
        if desk.entry(question).get("attempts"):
            self.remark(lambda: desk.mark_choice(question, count=False))
            self.state = self.what_is_kept()

    def words(self, response: object) -> str:
        if response is None:
            return super().words(None)
        return kind_of(self.question).in_words(self.question, response)

    def do_check(self, message: dict[str, object]) -> dict[str, object]:
        """Mark what is kept and count an attempt."""
        self.show_mark(self.desk.mark_choice(self.question))
        return {}
