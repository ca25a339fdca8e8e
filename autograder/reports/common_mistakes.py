"""The mistakes that a class made, and who made them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from autograder.course import Course
from autograder.gradebook.record import Record
from autograder.intake.long_list import LongList
from autograder.questions.registry import kind_of


@dataclass(frozen=True)
class Mistake:
    """A mistake, and who made it; if the key does not name it, it is told by where it fails."""

    question: str
    name: str
    named: bool
    students: Sequence[str]


def common_mistakes(course: Course, records: Iterable[Record]) -> list[Mistake]:
    """Every mistake that somebody made, those with a name first, and of them the most common."""
    made = MistakesMade(course)
    for record in records:
        made.add(record)
    return made.mistakes()


class MistakesMade:
    """Gathers `common_mistakes`, one record after the other."""

    def __init__(self, course: Course) -> None:
        self._course = course
        self._made: dict[tuple[str, str, bool], LongList[str]] = {}

    def add(self, record: Record) -> None:
        """Take in one submission."""
        marks = record.marks
        for question in self._course.questions.values():
            mark = marks.get(question.id)
            if mark is None or mark.status not in ("wrong", "partial"):
                continue
            kind = kind_of(question)
            drawn = self._course.entries_of(question.id, record.graded.numbers_of)
            known = kind.known_mistakes(question, mark, drawn)
            for name in known or kind.other_mistakes(question, mark):
                key = (question.id, name, bool(known))
                self._made.setdefault(key, LongList(str)).append(record.student)

    def mistakes(self) -> list[Mistake]:
        """All of them, in the order of `common_mistakes`."""
        order = {id: position for position, id in enumerate(self._course.questions)}
        return sorted(
            (Mistake(*mistake, students) for mistake, students in self._made.items()),
            key=lambda m: (not m.named, -len(m.students), order[m.question], m.name),
        )
