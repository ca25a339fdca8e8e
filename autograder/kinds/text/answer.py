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

from dataclasses import dataclass
from typing import Any

from autograder.kinds.answer import Answer
from autograder.kinds.text.question import Text
from autograder.kinds.toml_table import Table


@dataclass(frozen=True)
class Level:
    """How well a criterion is met, what that earns, and what a student is told."""

    name: str
    points: float
    feedback: str


@dataclass(frozen=True)
class Criterion:
    """One thing to look for, with its levels from best to worst."""

    name: str
    levels: tuple[Level, ...]

    def level(self, name: str) -> Level | None:
        """The level of this name."""
        return next((level for level in self.levels if level.name == name), None)


@dataclass(frozen=True)
class TextAnswer(Answer):
    """The key to a text question: the rubric, and ``model``, an answer that earns all points."""

    model: str
    rubric: tuple[Criterion, ...]


def read_answer(
    question: Text, table: Table, alternatives: list[Table], common: dict[str, Any]
) -> TextAnswer:
    """The key in an author's table.

    Raises:
        CourseError: if the best levels do not add up to the question's points.
    """
    if alternatives:
        raise table.error("a text has no alternatives: write criteria with levels")
    rubric = tuple(_criterion(entry) for entry in table.tables("criterion", "criterion"))
    if not rubric:
        raise table.error("the rubric is empty; write at least one criterion")
    if len({criterion.name for criterion in rubric}) != len(rubric):
        raise table.error("two criteria have the same name")
    best = sum(criterion.levels[0].points for criterion in rubric)
    if abs(best - question.points) > 1e-9:
        raise table.error(
            f"the best levels add up to {best:g} points, and the question has {question.points:g}"
        )
    return TextAnswer(**common, alternatives=(), model=table.text("model"), rubric=rubric)


def _criterion(table: Table) -> Criterion:
    levels = []
    for entry in table.tables("levels", "level"):
        levels.append(
            Level(entry.text("name"), float(entry.number("points")), entry.text("feedback", ""))
        )
        entry.done()
    name = table.text("name")
    table.done()
    if len(levels) < 2:
        raise table.error("a criterion needs at least two levels")
    if len({level.name for level in levels}) != len(levels):
        raise table.error("two levels have the same name")
    points = [level.points for level in levels]
    if points != sorted(points, reverse=True) or points[-1] < 0:
        raise table.error("write the levels from the most points to the fewest, none below 0")
    return Criterion(name, tuple(levels))
