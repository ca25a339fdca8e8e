"""Nameless responses of a class are clustered by what they did."""

from types import SimpleNamespace

from autograder.kinds.function.marking import fingerprint
from autograder.questions.mark import Mark
from autograder.reports.nameless import nameless


def record(student, evidence, code="x", alternative=None):
    mark = Mark("Q1", "wrong", 0, 1, "no", alternative, code=code, evidence=evidence)
    return SimpleNamespace(student=student, marks={"Q1": mark})


def test_equal_outcomes_are_one_cluster_with_the_shortest_response():
    found = nameless(
        [
            record("ada", "outcomes 1", "longer"),
            record("bob", "outcomes 1", "short"),
            record("cyd", "outcomes 2"),
            record("dee", "outcomes 1", "named", "known"),
        ],
        least=2,
    )
    assert [(c.students, c.typical) for c in found] == [(("ada", "bob"), "short")]


def test_a_fingerprint_forgives_rounding_and_nothing_else():
    one = fingerprint([{"value": 0.1 + 0.2}, {"value": [1, 2]}])
    assert one == fingerprint([{"value": 0.3}, {"value": [1, 2]}])
    assert one != fingerprint([{"value": 0.3}, {"value": [2, 1]}])
