"""Text, as the engine sees it: kept like any choice, and never marked by a machine."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from autograder.errors import UsageError
from autograder.exchange.printable import printable
from autograder.kinds.text import question as asked
from autograder.kinds.text.answer import TextAnswer, check_text
from autograder.kinds.text.question import Text
from autograder.language import _
from autograder.questions.choice_kinds import ChoiceKind
from autograder.questions.mark import Mark, not_attempted

if TYPE_CHECKING:
    from autograder.kinds.text.widget import TextWidget
    from autograder.student.desk import Desk


class TextKind(ChoiceKind[Text, TextAnswer]):
    """An answer in words, marked by a person with a rubric."""

    name = "text"
    by_hand = True
    question_type = Text
    answer_type = TextAnswer

    def check_answer(self, question: Text, answer: TextAnswer) -> None:
        check_text(question, answer)

    def fits(self, question: Text, response: object) -> bool:
        return isinstance(response, str) and len(response) <= question.longest

    def is_untouched(self, question: Text, response: object) -> bool:
        return not str(response).strip()

    def read_response(self, question: Text, response: object) -> object:
        if not isinstance(response, str):
            sentence = _("{question} asks for words: respond with a text in quotes.")
            raise UsageError(sentence.format(question=question.id))
        response = "".join(c if c >= " " or c in "\n\t" else " " for c in response)
        if len(response) > question.longest:
            raise UsageError(
                _(
                    "That has {count} characters, and {question} takes {most}; shorten it. "
                    "Nothing was changed."
                ).format(count=len(response), question=question.id, most=question.longest)
            )
        return response

    def in_words(self, question: Text, response: object) -> str:
        return str(response)

    def mark_choice(self, question: Text, answer: TextAnswer, response: object) -> Mark:
        if not isinstance(response, str) or self.is_untouched(question, response):
            return not_attempted(question)
        # One that is too long was not written in the field; whoever marks it sees that it is cut.
        said = response if len(response) <= asked.MOST else response[: asked.MOST] + " …"
        shown = printable(said, " ", keep="\n")
        return Mark(
            question.id,
            "recorded",
            0.0,
            question.points,
            _("Kept. A person will mark it."),
            explanation=answer.explanation,
            understood=shown,
        )

    def lines(self, question: Text, response: object) -> list[str]:
        kept = [f"> {line}" for line in str(response).splitlines()] if response else []
        return [
            *kept,
            "",
            _("Answer with a line of code: {call}").format(
                call=f"`{self.respond_line(question, None)}`"
            ),
        ]

    def respond_line(self, question: Text, response: object) -> str:
        return f'ask("{question.id}").respond("""...""")'

    def widget(
        self, desk: Desk, question: Text, value: object = ..., mark: Mark | None = None
    ) -> TextWidget:
        from autograder.kinds.text.widget import TextWidget

        return TextWidget(desk, question)

    def read_as(self, question: Text, mark: Mark) -> list[str] | None:
        return None

    def solution(self, answer: TextAnswer) -> str:
        return repr(answer.model)

    def secrets(self, question: Text, answer: TextAnswer) -> Iterator[str]:
        yield from super().secrets(question, answer)
        yield answer.model
        for criterion in answer.rubric:
            yield criterion.name
            for level in criterion.levels:
                yield level.name
                yield level.feedback


KIND = TextKind()
