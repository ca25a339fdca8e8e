"""What is decided after the exam: which questions count, for how much, and the curve.

::

    dropped = ["Q1.2"]            # counts for nobody, and makes the whole smaller
    given = ["Q1.3"]              # full points for everybody who handed in
    bonus = ["Q3.1"]              # its points are extra: full points can be had without them

    [[excused]]
    student = "ada"               # a name, login, e-mail address or id
    questions = ["Q2.1"]          # or chapters = ["ransac"]: the rest counts for the whole
    reason = "was ill"

    [weights]                     # the points of each chapter, whatever its questions add up to
    place_recognition = 30
    ransac = 70

    [curve]
    factor = 1.1                  # first the factor, then the points; never above the most
    add = 2
    table = [[0, 0], [40, 50], [89, 89]]   # or straight lines between points before and after

    [resubmission]
    points = "best"               # or newest, mean

Lateness is taken off after all this, from each attempt by itself.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence, Sized
from dataclasses import dataclass, field
from itertools import pairwise
from statistics import fmean
from typing import TYPE_CHECKING, Protocol

from autograder.grading.graded_submission import Graded
from autograder.language import _

if TYPE_CHECKING:
    from autograder.course import Course


@dataclass(frozen=True)
class Curve:
    """A function of the points earned that never falls; ``table`` stands alone."""

    add: float = 0.0
    factor: float = 1.0
    table: tuple[tuple[float, float], ...] = ()

    def __call__(self, points: float, most: float) -> float:
        """The points after the curve, of at most ``most`` unless they were above before."""
        curved = _between(self.table, points) if self.table else points * self.factor + self.add
        return max(0.0, min(curved, max(most, points)))


class Work(Protocol):
    """What a scheme looks at of one student's work; `autograder.gradebook.record.Record` is one."""

    @property
    def student(self) -> str:
        """The student's key."""

    @property
    def graded(self) -> Graded:
        """How the submission was graded."""

    @property
    def overrides(self) -> Sized:
        """What a person decided, if anything."""

    def points(self, question: str) -> float | None:
        """The points for a question; None while a person has to mark it."""


@dataclass(frozen=True)
class Scheme:
    """What counts; ``questions`` gives each question of the course its chapter and its points.

    ``excused`` gives questions by the student's key. Without anything decided the points add up as
    they are.
    """

    questions: Mapping[str, tuple[str, float]]
    dropped: frozenset[str] = frozenset()
    given: frozenset[str] = frozenset()
    bonus: frozenset[str] = frozenset()
    excused: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    weights: Mapping[str, float] = field(default_factory=dict)
    curve: Curve | None = None
    resubmission: str = "newest"

    @property
    def most(self) -> float:
        """What a perfect submission earns without bonus questions."""
        if self.weights:
            return round(sum(self.weights.values()), 2)
        return round(sum(self._possible(()).values()), 2)

    def counts(self, question: str, record: Work) -> bool:
        """Whether the question counts for this student."""
        return question not in self.dropped and question not in self.excused.get(record.student, {})

    def points(self, question: str, raw: float | None, record: Work) -> float | None:
        """The points for a question: 0 for one that does not count, all for one that is given."""
        if question not in self.questions:
            return raw
        if not self.counts(question, record):
            return 0.0
        if question in self.given and record.graded.status != "unreadable":
            return max(raw or 0.0, self.questions[question][1])
        return raw

    def earned(self, record: Work) -> float:
        """The points earned on the scale of `most`, after the curve."""
        if record.graded.status == "unreadable" and not record.overrides:
            return 0.0
        excused = self.excused.get(record.student, {})
        possible = self._possible(excused)
        earned = dict.fromkeys(possible, 0.0)
        for question, (chapter, _points) in self.questions.items():
            if self.counts(question, record):
                earned[chapter] += record.points(question) or 0.0
        if self.weights:
            shares = {c: earned[c] / p for c, p in possible.items() if p > 0}
            weight = sum(self.weights[chapter] for chapter in shares)
            points = sum(self.weights[chapter] * share for chapter, share in shares.items())
            points *= self.most / weight if weight else 0.0
        else:
            points, whole = sum(earned.values()), sum(possible.values())
            if excused:
                points *= self.most / whole if whole else 0.0
        if self.curve is not None:
            points = self.curve(points, self.most)
        return round(points, 2)

    def of_attempts(self, totals: Sequence[float]) -> float:
        """The points for several attempts, oldest first."""
        if self.resubmission == "best":
            return max(totals)
        return round(fmean(totals), 2) if self.resubmission == "mean" else totals[-1]

    def remark(self, question: str, record: Work) -> str:
        """What the student has to know of how the question counts; "" if it is as usual."""
        if question in self.dropped:
            return _("This question was dropped: it counts for nobody.")
        reason = self.excused.get(record.student, {}).get(question)
        if reason is not None:
            if not reason:
                return _("You are excused from this question: the others count for the whole.")
            sentence = _(
                "You are excused from this question ({reason}): the others count for the whole."
            )
            return sentence.format(reason=reason)
        if question in self.given:
            return _("Everybody has the full points for this question.")
        return _("A bonus question: its points are extra.") if question in self.bonus else ""

    def _possible(self, excused: Mapping[str, str] | Sequence[str]) -> dict[str, float]:
        possible: dict[str, float] = {}
        for question, (chapter, points) in self.questions.items():
            possible.setdefault(chapter, 0.0)
            if question not in (self.dropped | self.bonus) and question not in excused:
                possible[chapter] += points
        return possible


def plain_scheme(course: Course) -> Scheme:
    """Every question counts as the course says."""
    return Scheme({q.id: (q.chapter, q.points) for q in course.questions.values()})


def _between(table: Sequence[tuple[float, float]], points: float) -> float:
    """Straight lines between the rows of a table; beyond its ends the last value."""
    if points <= table[0][0]:
        return table[0][1]
    for (low, low_value), (high, high_value) in pairwise(table):
        if points <= high:
            return low_value + (high_value - low_value) * (points - low) / (high - low)
    return table[-1][1]
