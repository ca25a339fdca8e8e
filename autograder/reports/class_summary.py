"""What the reports of a class say, gathered in one pass over its records, in bounded memory.

Of each kind of student that a page names, the first some hundred are kept, and how many there are;
the tables beside the page have all of them.
"""

from __future__ import annotations

from array import array
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from typing import Any, Generic, TypeVar

from autograder.course import Course
from autograder.gradebook.record import Record
from autograder.gradebook.student_names import Names
from autograder.language import N_
from autograder.reports.broken_questions import STOPPED
from autograder.reports.common_mistakes import Mistake, MistakesMade
from autograder.reports.json_output import most_for
from autograder.reports.predictions import Predicted
from autograder.reports.question_statistics import QuestionStatistics, QuestionSums
from autograder.reports.variant_difficulty import Difficulty, VariantSums
from autograder.reports.who_needs_help import Needy, needs_help, section_of

MOST_NAMED = 400  # students of one kind on a page
_MOST_REASONS = 1000  # of failures; students can make up as many as they like

T = TypeVar("T")
Failure = tuple[str, str, str]  # question, status, reason


@dataclass
class Some:
    """Students of one kind: how many, and the first of them."""

    count: int = 0
    first: list[str] = field(default_factory=list)

    def add(self, student: str) -> None:
        """One more."""
        self.count += 1
        if len(self.first) < MOST_NAMED:
            self.first.append(student)


@dataclass
class Section:
    """Everybody of one section: the totals, and how many need help."""

    totals: array[float] = field(default_factory=lambda: array("d"))
    needy: int = 0


@dataclass
class ClassFindings:
    """What is known of a class when all records were seen.

    ``totals`` and ``seconds`` have a number for each submission, ``chapters`` the sum of points by
    title; ``needy`` are the lowest. ``slowest`` and ``waiting`` are students with the seconds and
    the open questions.
    """

    names: Names = field(default_factory=Names)
    most: float = 0.0
    totals: array[float] = field(default_factory=lambda: array("d"))
    seconds: array[float] = field(default_factory=lambda: array("d"))
    chapters: dict[str, float] = field(default_factory=dict)
    questions: list[QuestionStatistics] = field(default_factory=list)
    mistakes: list[Mistake] = field(default_factory=list)
    predicted: list[Predicted] = field(default_factory=list)
    difficulties: list[Difficulty] = field(default_factory=list)
    needy: list[Needy] = field(default_factory=list)
    needy_count: int = 0
    needy_in: dict[str, Some] = field(default_factory=dict)
    sections: dict[str, Section] = field(default_factory=dict)
    slowest: list[tuple[float, str]] = field(default_factory=list)
    failures: dict[Failure, Some] = field(default_factory=dict)
    failure_count: int = 0
    nobodys: Some = field(default_factory=Some)
    waiting: list[tuple[str, tuple[str, ...]]] = field(default_factory=list)
    waiting_count: int = 0
    groups: Some = field(default_factory=Some)

    @property
    def count(self) -> int:
        """How many submissions there are."""
        return len(self.totals)


def gather(course: Course, records: Iterable[Record]) -> ClassFindings:
    """Go through the records once."""
    found = ClassFindings()
    found.predicted = [Predicted(asked) for asked in course.predictions.values()]
    sums, made, varied = QuestionSums(course), MistakesMade(course), VariantSums(course)
    needy: _Least[Needy] = _Least(lambda entry: (entry.total, entry.student))
    slowest: _Least[tuple[float, str]] = _Least(lambda entry: (-entry[0], entry[1]), 3)
    for record in records:
        sums.add(record)
        made.add(record)
        varied.add(record)
        for entry in found.predicted:
            entry.add(record)
        if not found.count:
            found.most = most_for(course, record)
        found.names.add(record)
        found.totals.append(record.total)
        found.seconds.append(record.graded.seconds)
        slowest.add((record.graded.seconds, record.student))
        for chapter in course.chapters:
            earned = sum(record.points(question.id) or 0.0 for question in chapter.questions)
            found.chapters[chapter.title] = found.chapters.get(chapter.title, 0.0) + earned
        _note_help(found, course, record, needy)
        _note_people(found, record)
        for failure in _failures(record):
            found.failure_count += 1
            if failure in found.failures or len(found.failures) < _MOST_REASONS:
                found.failures.setdefault(failure, Some()).add(record.student)
    found.names.settle()
    found.difficulties = varied.difficulties()
    found.questions, found.mistakes = sums.statistics(), made.mistakes()
    found.needy, found.slowest = needy.entries(), slowest.entries()
    return found


def _note_help(found: ClassFindings, course: Course, record: Record, needy: _Least[Needy]) -> None:
    section = found.sections.setdefault(section_of(record), Section())
    section.totals.append(record.total)
    entry = needs_help(course, record)
    if entry is None:
        return
    section.needy += 1
    found.needy_count += 1
    needy.add(entry)
    for title in entry.chapters:
        found.needy_in.setdefault(title, Some()).add(record.student)


def _note_people(found: ClassFindings, record: Record) -> None:
    if not record.people:
        found.nobodys.add(record.student)
    elif len(record.people) > 1:
        found.groups.add(record.student)
    if record.open:
        found.waiting_count += 1
        if len(found.waiting) < MOST_NAMED:
            found.waiting.append((record.student, record.open))


def _failures(record: Record) -> Iterator[Failure]:
    if record.graded.status == "unreadable":
        yield N_("everything"), "unreadable", " ".join(record.graded.notes)
        return
    for mark in record.graded.marks:
        if mark.status in STOPPED:
            yield mark.question, mark.status, mark.feedback


class _Least(Generic[T]):
    """The entries that come first by ``key``, at most so many."""

    def __init__(self, key: Callable[[T], Any], most: int = MOST_NAMED) -> None:
        self._key, self._most = key, most
        self._entries: list[T] = []

    def add(self, entry: T) -> None:
        self._entries.append(entry)
        if len(self._entries) > 2 * self._most:
            self._entries = self.entries()

    def entries(self) -> list[T]:
        return sorted(self._entries, key=self._key)[: self._most]
