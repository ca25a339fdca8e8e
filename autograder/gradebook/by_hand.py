"""Marking by hand: what waits for a person, in which order, and what a person's verdict becomes."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from autograder.course.questions import Question
from autograder.errors import UsageError
from autograder.gradebook.book import Gradebook
from autograder.gradebook.record import Record, response_digest
from autograder.gradebook.student_names import names_of
from autograder.gradebook.view import ClassView


@dataclass(frozen=True)
class Item:
    """One response that waits for a person; ``rubric`` is empty where the key has none."""

    question: Question
    record: Record
    rubric: Sequence[Any] = ()
    called: str = ""  # the student, told apart from others of the same name

    @property
    def why(self) -> str:
        """Why it waits."""
        return self.record.open_reason(self.question.id)

    @property
    def response(self) -> str:
        """What the student wrote."""
        mark = self.record.marks.get(self.question.id)
        return mark.understood if mark else ""

    def secret_name(self, salt: str) -> str:
        """A name that says nothing of the student."""
        told = f"{salt}\0{self.record.student}\0{self.question.id}"
        return hashlib.sha256(told.encode("utf-8", "replace")).hexdigest()[:16]


def open_items(view: ClassView, question: str | None = None) -> list[Item]:
    """What waits, question by question; within one in an order that says nothing of names."""
    items = []
    names = names_of(view.records)
    for asked in view.course.questions.values():
        if question is not None and asked.id != question:
            continue
        rubric = getattr(view.course.key[asked.id], "rubric", ())
        found = [
            Item(asked, r, rubric, names[r.student]) for r in view.records if asked.id in r.open
        ]
        items += sorted(found, key=lambda item: item.secret_name(""))
    return items


def give(
    book: Gradebook,
    item: Item,
    levels: Mapping[str, str],
    points: float | None,
    comment: str,
    author: str,
) -> float:
    """Keep a verdict and return its points.

    It has a level for each criterion, or points where there is no rubric.

    Raises:
        UsageError: if a criterion has no level, or the points are none.
    """
    said = []
    if item.rubric:
        points = 0.0
        for criterion in item.rubric:
            level = criterion.level(levels.get(criterion.name, ""))
            if level is None:
                raise UsageError(f"Choose a level for {criterion.name!r}.")
            points += level.points
            if level.feedback:
                said.append(level.feedback)
    if points is None or not 0 <= points < float("inf"):
        raise UsageError("Give points of at least 0.")
    mark = item.record.marks.get(item.question.id)
    is_open = mark is not None and mark.status == "recorded"
    reason = " ".join([*said, comment.strip()]).strip() or "Marked by hand."
    book.override(
        item.record.student,
        item.question.id,
        round(points, 2),
        reason,
        author,
        {criterion.name: levels[criterion.name] for criterion in item.rubric},
        response_digest(mark) if mark is not None and is_open else "",
    )
    return round(points, 2)
