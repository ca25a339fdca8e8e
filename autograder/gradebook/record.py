"""What the gradebook knows of one student: the work, its marks, and what people decided."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from autograder.grading.graded import Graded
from autograder.intake.origin import Origin
from autograder.marking import Mark


@dataclass(frozen=True)
class Override:
    """Points that a person gave for a question, in place of the mark's."""

    student: str
    question: str
    points: float
    reason: str
    made_at: str


@dataclass(frozen=True)
class Note:
    """A remark about a student, for the instructors only."""

    student: str
    text: str
    made_at: str


@dataclass(frozen=True)
class Record:
    """One student's submission with marks, overrides, notes and lateness.

    ``handed_in`` is a time in UTC, ISO 8601, or None if it is not known; ``late_percent`` is taken
    off the points earned; ``isolation`` is what kept the student's code in.
    """

    graded: Graded
    run: int
    seed: int
    overrides: Mapping[str, Override] = field(default_factory=dict)
    notes: tuple[Note, ...] = ()
    handed_in: str | None = None
    late_days: int = 0
    late_percent: float = 0.0
    isolation: str = ""

    @property
    def student(self) -> str:
        """The student, as the submission is called."""
        return self.graded.submission.student

    @property
    def origin(self) -> Origin:
        """What the download said of it: layout, whose, when, which attempt."""
        return self.graded.submission.origin

    @property
    def marks(self) -> dict[str, Mark]:
        """The marks by question; an override changes the points, not the mark."""
        return {mark.question: mark for mark in self.graded.marks}

    def points(self, question: str) -> float | None:
        """The points that count for a question; None if it was never marked."""
        override = self.overrides.get(question)
        if override is not None:
            return override.points
        mark = self.marks.get(question)
        return None if mark is None else mark.points

    @property
    def earned(self) -> float:
        """The points earned, before anything is taken off for lateness."""
        questions = self.marks.keys() | self.overrides.keys()
        return round(sum(self.points(question) or 0.0 for question in questions), 2)

    @property
    def deduction(self) -> float:
        """What lateness costs, in points."""
        return round(max(self.earned, 0.0) * self.late_percent / 100, 2)

    @property
    def total(self) -> float:
        """The points that count."""
        return round(self.earned - self.deduction, 2)
