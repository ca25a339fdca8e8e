"""What is right: formulas, and the points at which a response is compared with them."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta, field

from autograder.kinds.expression.question import Expression
from autograder.questions.answer import Answer, PublicAlternative
from autograder.questions.author_tables import FieldError, Text


class ExpressionAlternative(PublicAlternative, frozen=True, kw_only=True):
    """A formula, equal up to multiples of ``modulo`` (a formula too) if that is given."""

    expression: Text
    modulo: str | None = None


class ExpressionAnswer(Answer, frozen=True, kw_only=True):
    """The key to an expression question.

    ``sample`` gives each free symbol the range in which hidden points are drawn, ``derived`` the
    formulas of the symbols that follow from them.
    """

    sample: Annotated[
        dict[str, tuple[float, float]],
        Meta(description="the range of each symbol at hidden points"),
    ]
    derived: Annotated[
        dict[str, str], Meta(description="formulas of the symbols that follow from others")
    ] = field(default_factory=dict)
    free_of: tuple[str, ...] = ()
    free_of_feedback: str = ""
    alternatives: tuple[ExpressionAlternative, ...] = field(default=(), name="alternative")

    def __post_init__(self) -> None:
        super().__post_init__()
        for name, (low, high) in self.sample.items():
            if not low < high:
                raise FieldError(
                    f"sample must give {name!r} two numbers, the smaller one first", "sample", name
                )
        if not set(self.free_of) <= self.sample.keys():
            raise FieldError("give each symbol of free_of a range in sample", "free_of")


def check_expression(question: Expression, answer: ExpressionAnswer) -> None:
    """Whether a key gives values to the question's symbols, and to nothing else.

    Raises:
        ValueError: if not.
    """
    # What a response must be free of is drawn too, even if the question does not declare it.
    drawn = answer.sample.keys() | answer.derived.keys()
    wanted = question.symbols.keys() | {*answer.free_of}
    if drawn != wanted:
        problems = [
            *(
                f"{name!r} has no range in sample and no formula in derived"
                for name in sorted(wanted - drawn)
            ),
            *(
                f"{name!r} in sample or derived is no symbol of the question, nor in free_of"
                for name in sorted(drawn - wanted)
            ),
        ]
        raise FieldError(", and ".join(problems), "sample")
