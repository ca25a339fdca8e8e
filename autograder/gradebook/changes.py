"""What another run of the grader changes, question by question."""

from __future__ import annotations

from dataclasses import dataclass

from autograder.gradebook.record import Record
from autograder.grading.graded_submission import Graded
from autograder.marking import Mark


@dataclass(frozen=True)
class Change:
    """A mark before and after; ``overridden`` points stay whatever the mark says."""

    student: str
    question: str
    before: Mark
    after: Mark
    overridden: bool

    @property
    def points(self) -> float:
        """How many points more it gives the student."""
        return 0.0 if self.overridden else round(self.after.points - self.before.points, 2)


def changes_of(before: Record, graded: Graded) -> list[Change]:
    """The marks of a student that differ in points, status or the alternative that matched.

    A question that had no mark before is no change.
    """
    old_marks = before.marks
    return [
        Change(before.student, new.question, old, new, new.question in before.overrides)
        for new in graded.marks
        if (old := old_marks.get(new.question)) is not None and _verdict(old) != _verdict(new)
    ]


def _verdict(mark: Mark) -> tuple[object, ...]:
    return mark.points, mark.max_points, mark.status, mark.alternative
