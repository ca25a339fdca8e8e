"""Kinds whose responses a notebook holds, in a variable or a function: evaluated beside it."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from autograder.errors import CourseError
from autograder.exchange.why_unusable import REASONS, UNREAD
from autograder.language import _
from autograder.questions.drawn import Drawn
from autograder.questions.exercise import Exercise, heading
from autograder.questions.kind_protocol import A, Kind, Q
from autograder.questions.mark import Mark, not_attempted

FEWEST_MISTAKES = 2


class CodeKind(Kind[Q, A]):
    """A kind whose response is named in the notebook; its ``inside`` evaluates it there."""

    @abstractmethod
    def mark_given(
        self,
        question: Q,
        answer: A,
        drawn: Drawn,
        response: dict[str, object],
        understood: str,
    ) -> Mark | None:
        """Mark what ``inside`` made of a response; None if that is not what it makes."""

    def why_unusable(self, question: Q, reason: str) -> str:
        """In words, why a response is none that can be marked."""
        return _(REASONS.get(reason, UNREAD))

    def fits(self, question: Q, response: object) -> bool:
        return False  # nothing is kept but what was typed into a field

    def mark(
        self, question: Q, answer: A, drawn: Drawn, response: object, understood: str = ""
    ) -> Mark:
        response = response if isinstance(response, dict) else {}
        mark = self._mark(question, answer, drawn, response, understood)
        return mark if mark.understood else replace(mark, understood=understood)

    def _mark(
        self, question: Q, answer: A, drawn: Drawn, response: dict[str, object], understood: str
    ) -> Mark:
        state, reason = _text(response.get("state")), _text(response.get("reason"))
        if state == "not attempted":
            return not_attempted(question)
        if state == "unusable" and reason == "missing":
            return not_attempted(
                question, _("Nothing called {name} was found.").format(name=question.name)
            )
        if state == "raised":
            feedback = _("Evaluating {name} raised an exception.").format(name=question.name)
            return Mark(question.id, "error", 0.0, question.points, feedback)
        if state == "given":
            mark = self.mark_given(question, answer, drawn, response, understood)
            if mark is not None:
                return mark
        return Mark(
            question.id,
            "wrong",
            0.0,
            question.points,
            _("{name} cannot be marked: {why}.").format(
                name=question.name, why=self.why_unusable(question, reason)
            ),
            alternative="not usable",
        )

    def lines(self, question: Q, response: object) -> list[str]:
        sentence = _("Check it with {call}.")
        return [sentence.format(call=f"`{self.respond_line(question, response)}`")]

    def respond_line(self, question: Q, response: object) -> str:
        return f'check("{question.id}", {question.name})'

    def more_heading(self, question: Q) -> list[str]:
        """What a chapter's notebook shows below the prompt, as lines of Markdown."""
        return []

    def cells(self, question: Q, answer: A, root: Path) -> tuple[str, str]:
        """The student's stub, and the same cell solved.

        Raises:
            CourseError: if the key does not say how.
        """
        if not answer.code:
            raise CourseError(f"The answer to {question.id} has no code for the solved notebook.")
        return f"{question.name} = ...", f"{question.name} = {answer.code}"

    def exercise(self, question: Q, answer: A, root: Path) -> Exercise:
        stub, solved = self.cells(question, answer, root)
        return Exercise(
            heading=heading(question, ["", question.prompt, *self.more_heading(question)]),
            stub=stub,
            solved=solved,
            check=f'check("{question.id}", {question.name})',
        )

    def problems(self, question: Q, answer: A) -> Iterator[str]:
        yield from self.too_few_mistakes(answer)
        if all(entry.is_mistake for entry in answer.alternatives):
            yield "no alternative has full credit; add the right one."

    def too_few_mistakes(self, answer: A) -> Iterator[str]:
        """The problem of a key that knows too few mistakes."""
        count = sum(entry.is_mistake for entry in answer.alternatives)
        if count < FEWEST_MISTAKES:
            yield f"{count} known mistakes; name at least {FEWEST_MISTAKES}, with feedback."


def _text(value: object) -> str:
    return value if isinstance(value, str) else ""
