"""Who needs help, in a class small enough to look through."""

from __future__ import annotations

from autograder.course import Course
from autograder.gradebook import Record
from autograder.reports.who_needs_help import who_needs_help
from tests.classroom import class_of, graded, mark


def test_who_needs_help_are_the_lowest_and_those_whose_work_does_not_run(course: Course):
    stopped = [mark(f"Q{n}", 0, status="timeout") for n in (1, 2)]
    records = [
        *class_of((1, 1, 1, 1), (0, 0, 0, 0.5)),
        Record(graded("z", status="unreadable"), 1, 1),
        Record(graded("slow", *stopped, mark("Q3", 1), mark("Q4", 1, 4)), 1, 1),
    ]
    needy = {entry.student: " ".join(entry.reasons) for entry in who_needs_help(course, records)}
    assert list(needy) == ["z", "student 01", "slow"]
    assert "could not be opened" in needy["z"]
    assert "less than half" in needy["student 01"]
    assert needy["slow"] == "2 questions ended at the time limit"
