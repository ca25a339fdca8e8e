"""What the gradebook knows of one student: the work, its marks, and what people decided."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from autograder.grading.graded_submission import Graded
from autograder.intake.origin import Origin
from autograder.intake.person import Person
from autograder.language import _
from autograder.marking import Mark
from autograder.marking.draw import seed_of_set

if TYPE_CHECKING:
    from autograder.gradebook.grading_scheme import Scheme


@dataclass(frozen=True)
class Override:
    """Points that a person gave for a question, in place of the mark's.

    ``points`` is None if it withdraws an earlier one. ``levels`` are those reached in the criteria
    of a rubric, and ``response`` is the `response_digest` of what was marked, "" if the points hold
    whatever the student hands in. ``reason`` is shown to the student.
    """

    student: str
    question: str
    points: float | None
    reason: str
    made_at: str
    author: str = ""
    levels: Mapping[str, str] = field(default_factory=dict)
    response: str = ""

    def says_the_same(self, other: Override | None) -> bool:
        """Whether both give the same points for the same reasons, whoever gave them."""
        return other is not None and (self.points, dict(self.levels)) == (
            other.points,
            dict(other.levels),
        )


@dataclass(frozen=True)
class Note:
    """A remark about a student, for the instructors only."""

    student: str
    text: str
    made_at: str
    author: str = ""


@dataclass(frozen=True)
class Attempt:
    """What a student had handed in before: its marks, and what people had decided by then."""

    marks: tuple[Mark, ...]
    handed_in: str | None
    late_percent: float
    replaced_at: str
    fingerprint: str = ""


@dataclass(frozen=True)
class Record:
    """One student's submission with marks, overrides, notes and lateness.

    ``handed_in`` is a time in UTC, ISO 8601, or None if it is not known; ``late_percent`` is taken
    off the points earned; ``isolation`` is what kept the student's code in. ``people`` are those of
    the class list whose work it is, if that is certain. ``disputes`` are points by hand, by
    question, that contradict each other. ``scheme`` is what was decided after the exam.
    ``set_number`` is that of the hidden inputs, which are others for other work of a student.
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
    course_version: str = ""
    attempts: tuple[Attempt, ...] = ()
    disputes: Mapping[str, tuple[Override, ...]] = field(default_factory=dict)
    people: tuple[Person, ...] = ()
    scheme: Scheme | None = None
    set_number: int = 0

    @property
    def inputs_seed(self) -> int:
        """What drew the hidden inputs of this work."""
        return seed_of_set(self.seed, self.set_number)

    @property
    def student(self) -> str:
        """The student's key: what the submission is called."""
        return self.graded.submission.student

    @property
    def name(self) -> str:
        """What the student is called: the names of the class list, or what the download says."""
        if self.people:
            return ", ".join(person.name for person in self.people)
        names = [claim.name for claim in self.origin.claims if claim.name]
        return ", ".join(names) or self.student

    @property
    def origin(self) -> Origin:
        """What the download said of it: layout, whose, when, which attempt."""
        return self.graded.submission.origin

    @property
    def marks(self) -> dict[str, Mark]:
        """The marks by question; an override changes the points, not the mark."""
        return {mark.question: mark for mark in self.graded.marks}

    def open_reason(self, question: str) -> str:
        """Why a person has to mark the question before it has points; "" if nobody has to."""
        if question in self.disputes:
            gave = f" {_('and')} ".join(
                f"{entry.author or _('somebody')} {_points(entry.points)}"
                for entry in self.disputes[question]
            )
            return _("two people gave different points: {points}").format(points=gave)
        mark, override = self.marks.get(question), self.overrides.get(question)
        if override is None:
            waits = mark is not None and mark.status == "recorded"
            return _("it waits for a person to mark it") if waits else ""
        if override.response and mark is not None and override.response != response_digest(mark):
            return _("the response has changed since it was marked by hand")
        return ""

    @property
    def open(self) -> tuple[str, ...]:
        """The questions that a person still has to mark."""
        questions = [*self.marks, *(set(self.disputes) - self.marks.keys())]
        if self.scheme is not None:
            questions = [q for q in questions if self.scheme.counts(q, self)]
        return tuple(question for question in questions if self.open_reason(question))

    def points(self, question: str) -> float | None:
        """The points that count for a question; None if it was never marked, or not yet."""
        raw = None if self.open_reason(question) else self.points_before_scheme(question)
        return raw if self.scheme is None else self.scheme.points(question, raw, self)

    def points_before_scheme(self, question: str) -> float | None:
        """The points as they were marked, by the grader or by hand."""
        override = self.overrides.get(question)
        if override is not None:
            return override.points
        mark = self.marks.get(question)
        return None if mark is None else mark.points

    @property
    def questions(self) -> set[str]:
        """The questions that have a mark or an override."""
        return self.marks.keys() | self.overrides.keys()

    @property
    def earned(self) -> float:
        """The points earned, before anything is taken off for lateness."""
        if self.scheme is not None:
            return self.scheme.earned(self)
        return round(sum(self.points(question) or 0.0 for question in self.questions), 2)

    @property
    def deduction(self) -> float:
        """What lateness costs, in points."""
        return round(max(self.earned, 0.0) * self.late_percent / 100, 2)

    @property
    def total(self) -> float:
        """The points that count."""
        alone = round(self.earned - self.deduction, 2)
        if self.scheme is None or not self.attempts:
            return alone
        return self.scheme.of_attempts([*(past.total for past in self.past()), alone])

    @property
    def final(self) -> float | None:
        """The points that count, or None while a question waits for a person."""
        return None if self.open else self.total

    def past(self) -> list[Record]:
        """The earlier attempts, oldest first, each with what people had decided by then."""
        return [
            replace(
                self,
                graded=replace(self.graded, marks=attempt.marks, fingerprint=attempt.fingerprint),
                overrides={
                    question: override
                    for question, override in self.overrides.items()
                    if override.made_at <= attempt.replaced_at
                },
                disputes={},
                handed_in=attempt.handed_in,
                late_percent=attempt.late_percent,
                attempts=(),
            )
            for attempt in self.attempts
        ]


def response_digest(mark: Mark) -> str:
    """What tells one response from another: a digest of what it was understood as."""
    return hashlib.sha256(mark.understood.encode("utf-8", "replace")).hexdigest()[:16]


def _points(points: float | None) -> str:
    return "nothing" if points is None else f"{points:g}"
