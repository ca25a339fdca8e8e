"""What a run has done so far; in memory it takes the same room for any class."""

from __future__ import annotations

from autograder.gradebook import Gradebook
from autograder.gradebook.changes import Change, changes_of
from autograder.grading.graded_submission import Graded
from autograder.grading.journal import STOPPED_THE_GRADER
from autograder.intake.long_list import LongList


class Tally:
    """Counts what was graded, and compares it with what the gradebook had.

    ``earned`` are the points that students with changed marks had before.
    """

    def __init__(self, book: Gradebook) -> None:
        self._book = book
        self.students: LongList[str] = LongList(str)
        self.unreadable: set[str] = set()
        self.passed_by: list[str] = []  # what stopped the grader itself
        self.changed: LongList[Change] = LongList(Change)
        self.earned: dict[str, float] = {}

    @property
    def count(self) -> int:
        """How many submissions were graded."""
        return len(self.students)

    def add(self, entry: Graded) -> None:
        """Take notice of one submission, before it is stored."""
        student = entry.submission.student
        self.students.append(student)
        if entry.status == "unreadable":
            self.unreadable.add(student)
        if STOPPED_THE_GRADER in entry.notes:
            self.passed_by.append(student)
        for before in self._book.records_of([student]):
            if changed := changes_of(before, entry):
                self.changed += changed
                self.earned[student] = before.earned

    def changes(self) -> list[Change]:
        """All that changed, by student."""
        return sorted(self.changed, key=lambda change: change.student)
