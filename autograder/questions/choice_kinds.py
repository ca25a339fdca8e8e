"""Kinds whose responses are data: clicked in a widget, kept in a file, marked without running."""

from __future__ import annotations

from abc import abstractmethod
from pathlib import Path

from autograder.questions.drawn import Drawn
from autograder.questions.exercise import Exercise, heading
from autograder.questions.kind_protocol import A, Kind, Q
from autograder.questions.mark import Mark, not_attempted


class ChoiceKind(Kind[Q, A]):
    """A kind that ``ask`` asks and whose widget keeps the response."""

    @abstractmethod
    def mark_choice(self, question: Q, answer: A, response: object) -> Mark:
        """Mark what is kept; it may be anything."""

    @abstractmethod
    def solution(self, answer: A) -> str:
        """The right response as code, for the solved notebook."""

    def mark(
        self, question: Q, answer: A, drawn: Drawn, response: object, understood: str = ""
    ) -> Mark:
        if response is None:
            return not_attempted(question)
        return self.mark_choice(question, answer, response)

    def exercise(self, question: Q, answer: A, root: Path) -> Exercise:
        ask = f'ask("{question.id}")'
        return Exercise(
            heading=heading(question),  # the widget shows the prompt
            stub=ask,
            solved=f"{ask}.respond({self.solution(answer)})",
            check=None,
        )
