"""What an exercise looks like: the stub for a student, the same cell solved, and the check."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from autograder.questions.question import Question


@dataclass(frozen=True)
class Exercise:
    """The cells of one exercise; ``check`` is None where the answer cell marks itself."""

    heading: str
    stub: str
    solved: str
    check: str | None


def heading(question: Question, more: Iterable[str] = ()) -> str:
    """The Markdown above an exercise: id, title, points, and whatever more lines."""
    points = f"{question.points:g} point" + ("" if question.points == 1 else "s")
    lines = [f"### {question.id} · {question.title}", "", f"*{points}*", *more]
    return "\n".join(lines)
