"""The mistakes of a class small enough to count by hand."""

from __future__ import annotations

from autograder.course import Course
from autograder.gradebook import Record
from autograder.marking import Part
from autograder.reports.common_mistakes import common_mistakes
from tests.classroom import graded, mark


def test_mistakes_are_counted_by_name_and_the_most_common_is_first(course: Course):
    records = [
        Record(graded("a", mark("Q2", 0.25, alternative="added")), 1, 1),
        Record(graded("b", mark("Q2", 0.25, alternative="added")), 1, 1),
        Record(graded("c", mark("Q2", 1, alternative="right")), 1, 1),
        Record(
            graded(
                "d",
                mark(
                    "Q1",
                    0.5,
                    understood="true, true",
                    parts=(Part("Statement 1", False, "no"), Part("Statement 2", True, "")),
                ),
                mark("Q4", 0.5, 4, parts=(Part("a basket", False, ""), Part("three", True, ""))),
            ),
            1,
            1,
        ),
    ]
    found = [
        (m.question, m.name, m.named, len(m.students)) for m in common_mistakes(course, records)
    ]
    assert found == [
        ("Q2", "added", True, 2),
        ("Q1", "statement 1 called true", True, 1),
        ("Q4", "wrong on: a basket", False, 1),
    ]


def test_a_function_that_is_wrong_everywhere_is_one_mistake_not_many(course: Course):
    parts = (Part("a basket", False, ""), Part("three", False, ""))
    (mistake,) = common_mistakes(course, [Record(graded("a", mark("Q4", 0, parts=parts)), 1, 1)])
    assert mistake.name == "wrong on all kinds of input"
