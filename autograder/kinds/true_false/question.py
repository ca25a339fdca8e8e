"""What is asked: statements to call true or false."""

from __future__ import annotations

from typing import Annotated, ClassVar

from msgspec import Meta

from autograder.questions.author_tables import FieldError, Text, second_of
from autograder.questions.question import Question


class TrueFalse(Question, frozen=True, kw_only=True, tag="true_false"):
    """Statements to call true or false, one point each."""

    kind = "true_false"
    refused: ClassVar[dict[str, str]] = {"points": "each statement is a point, so remove it"}
    statements: Annotated[tuple[Text, ...], Meta(min_length=1)]
    draws: Annotated[
        tuple[tuple[int, ...], ...],
        Meta(description="which statements a student may get, by number; the sheet's first"),
    ] = ()

    def __post_init__(self) -> None:
        super().__post_init__()
        if (twice := second_of(self.statements)) is not None:
            raise FieldError("this statement stands there already", "statements", twice)

    @property
    def points(self) -> float:
        """One for each statement."""
        return float(len(self.statements))
