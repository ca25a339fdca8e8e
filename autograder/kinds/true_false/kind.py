"""True/false, as the engine sees it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from autograder.kinds.true_false import response as given
from autograder.kinds.true_false.answer import TrueFalseAnswer
from autograder.kinds.true_false.marking import mark_true_false
from autograder.kinds.true_false.question import TrueFalse
from autograder.language import _
from autograder.questions.author_tables import FieldError
from autograder.questions.choice_kinds import ChoiceKind
from autograder.questions.mark import Mark

if TYPE_CHECKING:
    from autograder.kinds.true_false.widget import TrueFalseWidget
    from autograder.student.desk import Desk


class TrueFalseKind(ChoiceKind[TrueFalse, TrueFalseAnswer]):
    """Statements, each called true or false."""

    name = "true_false"
    parts_stand_alone = True
    drawn_fields = ("statements", "statement")
    question_type = TrueFalse
    answer_type = TrueFalseAnswer

    def check_answer(self, question: TrueFalse, answer: TrueFalseAnswer) -> None:
        if len(answer.statements) != len(question.statements):
            raise FieldError(
                f"there are {len(answer.statements)} statements, "
                f"but the question asks {len(question.statements)}",
                "statement",
            )

    def fits(self, question: TrueFalse, response: object) -> bool:
        return given.fits(question, response)

    def is_untouched(self, question: TrueFalse, response: object) -> bool:
        return not any(choice is not None for choice in given.chosen(question, response) or ())

    def read_response(self, question: TrueFalse, response: object) -> object:
        return given.read_response(question, response)

    def in_words(self, question: TrueFalse, response: object) -> str:
        return given.in_words(given.chosen(question, response) or [])

    def mark_choice(self, question: TrueFalse, answer: TrueFalseAnswer, response: object) -> Mark:
        return mark_true_false(question, answer, response)

    def lines(self, question: TrueFalse, response: object) -> list[str]:
        return given.lines(question, given.chosen(question, response) or [])

    def respond_line(self, question: TrueFalse, response: object) -> str:
        return given.respond_line(question, given.chosen(question, response))

    def widget(
        self, desk: Desk, question: TrueFalse, value: object = ..., mark: Mark | None = None
    ) -> TrueFalseWidget:
        from autograder.kinds.true_false.widget import TrueFalseWidget

        return TrueFalseWidget(desk, question)

    def read_as(self, question: TrueFalse, mark: Mark) -> list[str]:
        words = [word.strip() for word in mark.understood.split(",")]
        words += ["–"] * (len(question.statements) - len(words))
        return [
            f"{statement} **{_(word)}**"
            for statement, word in zip(question.statements, words, strict=False)
        ]

    def right_in_words(self, question: TrueFalse, answer: TrueFalseAnswer) -> list[str]:
        return [
            f"{str(known.truth).lower()}: {said}"
            for said, known in zip(question.statements, answer.statements, strict=True)
        ]

    def known_mistakes(
        self, question: TrueFalse, mark: Mark, drawn: Sequence[int] = ()
    ) -> list[str]:
        words = [word.strip() for word in mark.understood.split(",")]
        labels = [f"statement {number}" for number in range(1, len(mark.parts) + 1)]
        if len(drawn) == len(labels):  # the same place holds another statement for others
            labels = [f"statement {number} of the bank" for number in drawn]
        return [
            f"{label} called {word}"
            for label, part, word in zip(labels, mark.parts, words, strict=False)
            if part.right is False
        ]

    def other_mistakes(self, question: TrueFalse, mark: Mark) -> list[str]:
        return []

    def poor_draw(self, question: TrueFalse, answer: TrueFalseAnswer) -> Iterator[str]:
        true = sum(statement.truth for statement in answer.statements)
        if not 0 < true < len(answer.statements):
            yield "all its statements are true, or all are false; mix them."
        topics = [statement.topic for statement in answer.statements if statement.topic]
        for topic in sorted({topic for topic in topics if topics.count(topic) > 1}):
            yield (
                f"two of its statements are about {topic!r}, and one may give the other away; "
                "draw only one of them."
            )

    def solution(self, answer: TrueFalseAnswer) -> str:
        return repr([statement.truth for statement in answer.statements])

    def secrets(self, question: TrueFalse, answer: TrueFalseAnswer) -> Iterator[str]:
        yield from super().secrets(question, answer)
        for statement in answer.statements:
            yield statement.explanation
            yield statement.misconception


KIND = TrueFalseKind()
