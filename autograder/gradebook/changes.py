"""What another run of the grader changes, question by question."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from autograder.gradebook.record import Record
from autograder.grading.graded import Graded
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


def changes(before: Mapping[str, Record], graded: Iterable[Graded]) -> list[Change]:
    """The marks that differ in points, status or the alternative that matched, by student.

    A student or a question that had no mark before is no change.
    """
    found = []
    for entry in sorted(graded, key=lambda entry: entry.submission.student):
        record = before.get(entry.submission.student)
        if record is None:
            continue
        old_marks = record.marks
        for new in entry.marks:
            old = old_marks.get(new.question)
            if old is not None and _verdict(old) != _verdict(new):
                found.append(
                    Change(record.student, new.question, old, new, new.question in record.overrides)
                )
    return found


def _verdict(mark: Mark) -> tuple[object, ...]:
    return mark.points, mark.max_points, mark.status, mark.alternative
