"""What is right: the truth of each statement, and why."""

from __future__ import annotations

from msgspec import field

from autograder.questions.answer import Answer
from autograder.questions.author_tables import FieldError, Text, Written


class Statement(Written, frozen=True, kw_only=True):
    """The truth of one statement, why, and what somebody who says the opposite has in mind.

    Of statements with the same ``topic`` one contradicts another or gives it away, so that no
    student gets two of them.
    """

    truth: bool
    explanation: Text
    misconception: Text
    topic: str = ""


class TrueFalseAnswer(Answer, frozen=True, kw_only=True):
    """The key to a true/false question."""

    statements: tuple[Statement, ...] = field(name="statement")

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.alternatives:
            raise FieldError("put what is wrong into each statement's misconception", "alternative")
