"""What a class makes of a question, on classes small enough to reckon by hand."""

from __future__ import annotations

import numpy as np
import pytest

from autograder.course import Course
from autograder.gradebook import Record
from autograder.reports.correlations import FEWEST, Together
from autograder.reports.question_statistics import question_statistics
from tests.classroom import class_of, graded, mark


def test_difficulty_is_the_mean_share_among_those_who_tried(course: Course):
    untouched = mark("Q2", 0, status="not attempted")
    records = [
        Record(graded("a", mark("Q2", 1)), 1, 1),
        Record(graded("b", mark("Q2", 0.5)), 1, 1),
        Record(graded("c", untouched), 1, 1),
    ]
    statistics = {s.question.id: s for s in question_statistics(course, records)}
    assert statistics["Q2"].attempted == 2
    assert statistics["Q2"].difficulty == pytest.approx(0.75)
    assert statistics["Q3"].difficulty is None


def test_a_question_that_the_best_get_wrong_looks_broken(course: Course):
    strong, weak = (1, 1, 0, 1), (0, 0, 1, 0)
    statistics = {
        s.question.id: s for s in question_statistics(course, class_of(*[strong, weak] * 6))
    }
    assert statistics["Q3"].discrimination == pytest.approx(-1)
    assert "check the key" in statistics["Q3"].troubles[0]
    assert statistics["Q1"].discrimination > 0
    assert not statistics["Q1"].troubles


def test_a_question_without_a_single_point_looks_broken(course: Course):
    rows = [(1, 0, 1, 1), (0, 0, 1, 0)] * 6
    statistics = {s.question.id: s for s in question_statistics(course, class_of(*rows))}
    assert "Nobody earned a point" in statistics["Q2"].troubles[0]


def test_wrong_responses_that_no_mistake_names_are_counted(course: Course):
    records = [Record(graded(str(n), mark("Q2", 0)), 1, 1) for n in range(12)]
    statistics = {s.question.id: s for s in question_statistics(course, records)}
    assert statistics["Q2"].unnamed == 12
    assert any("no mistake in the key" in said for said in statistics["Q2"].troubles)


def test_a_few_submissions_are_no_evidence(course: Course):
    records = class_of(*[(1, 1, 0, 1), (0, 0, 1, 0)] * 2)
    assert all(not s.troubles for s in question_statistics(course, records))
    together = Together(2)
    for n in range(FEWEST - 1):
        together.add(np.array([n, 1.0]), np.array([n, n]))
    assert together.correlations() == [None, None]  # too few
    together.add(np.array([0.0, 1.0]), np.array([5.0, 5.0]))
    first, second = together.correlations()
    assert first is not None
    assert second is None  # what never varies


def test_correlations_that_are_gathered_are_those_of_the_whole():
    rng = np.random.default_rng(3)
    rows = rng.normal(1e6, 1.0, (200, 2, 5))
    together = Together(5)
    for row in rows:
        together.add(*row)
    wanted = [np.corrcoef(rows[:, 0, n], rows[:, 1, n])[0, 1] for n in range(5)]
    assert together.correlations() == pytest.approx(wanted, abs=1e-9)
