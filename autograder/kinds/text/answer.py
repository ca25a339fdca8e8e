"""What is right: a rubric, and an answer that would earn all of it.

::

    ["Q3.9"]
    model = "RANSAC counts inliers, so an outlier far away costs no more than one close by."
    explanation = "Squared errors are not bounded; counts are."
    [["Q3.9".criterion]]
    name = "the cost of an outlier"
    levels = [
        {name = "bounded, and why", points = 2},
        {name = "bounded, without a reason", points = 1, feedback = "Why is it bounded?"},
        {name = "missing", points = 0, feedback = "Compare the cost of one point far away."},
    ]
"""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta, field

from autograder.kinds.text.question import Text
from autograder.questions import author_tables
from autograder.questions.answer import Answer
from autograder.questions.author_tables import FieldError, Written, second_of


class Level(Written, frozen=True, kw_only=True):
    """How well a criterion is met, what that earns, and what a student is told."""

    name: author_tables.Text
    points: Annotated[float, Meta(ge=0)]
    feedback: str = ""


class Criterion(Written, frozen=True, kw_only=True):
    """One thing to look for, with its levels from best to worst."""

    name: author_tables.Text
    levels: tuple[Level, ...]

    def __post_init__(self) -> None:
        super().__post_init__()
        if len(self.levels) < 2:
            raise FieldError("a criterion needs at least two levels", "levels")
        if (twice := second_of(level.name for level in self.levels)) is not None:
            raise FieldError("two levels have the same name", "levels", twice, "name")
        points = [level.points for level in self.levels]
        if points != sorted(points, reverse=True):
            raise FieldError("write the levels from the most points to the fewest", "levels")

    def level(self, name: str) -> Level | None:
        """The level of this name."""
        return next((level for level in self.levels if level.name == name), None)


class TextAnswer(Answer, frozen=True, kw_only=True):
    """The key to a text question: the rubric, and ``model``, an answer that earns all points."""

    model: author_tables.Text
    rubric: Annotated[tuple[Criterion, ...], Meta(min_length=1)] = field(name="criterion")

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.alternatives:
            raise FieldError(
                "a text has no alternatives: write criteria with levels", "alternative"
            )
        if (twice := second_of(criterion.name for criterion in self.rubric)) is not None:
            raise FieldError("two criteria have the same name", "criterion", twice, "name")


def check_text(question: Text, answer: TextAnswer) -> None:
    """Whether the best levels add up to the question's points, and its model may be written.

    Raises:
        ValueError: if not.
    """
    best = sum(criterion.levels[0].points for criterion in answer.rubric)
    if abs(best - question.points) > 1e-9:
        raise FieldError(
            f"the best levels add up to {best:g} points, and the question has {question.points:g}",
            "criterion",
        )
    if len(answer.model) > question.longest:
        raise FieldError(
            f"model has {len(answer.model)} characters, and the question takes "
            f"{question.longest}; shorten it, or let longest be more",
            "model",
        )
