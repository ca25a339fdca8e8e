"""True/false questions: a point for each statement called right."""

import itertools

import pytest

from autograder.marking.marker import Marker


@pytest.fixture
def marker(toy) -> Marker:
    """Of the toy course, whose Q1.1 is true, false, true."""
    return Marker(toy.load(), seed=1)


@pytest.mark.parametrize("response", [*itertools.product([True, False, None], repeat=3)])
def test_every_statement_counts_by_itself(marker, response):
    mark = marker.mark("Q1.1", list(response))
    right = sum(said is truth for said, truth in zip(response, (True, False, True), strict=True))
    assert mark.credit == right / 3
    assert mark.points == round(right, 2)
    if set(response) == {None}:
        assert mark.status == "not attempted"
    else:
        assert mark.status == {0: "wrong", 3: "right"}.get(right, "partial")


def test_nothing_recorded_is_not_attempted(marker):
    mark = marker.mark("Q1.1", None)
    assert (mark.status, mark.credit, mark.max_points) == ("not attempted", 0, 3)


def test_a_wrong_call_gets_its_misconception_and_an_open_one_says_so(marker):
    mark = marker.mark("Q1.1", [True, True, None])
    assert [part.right for part in mark.parts] == [True, False, None]
    assert mark.parts[1].feedback.startswith("Most solids sink")
    assert "Not answered" in mark.parts[2].feedback
    assert mark.feedback == "1 of 3 statements right. Look again at statement 2."
    assert mark.understood == "true, true, –"


def test_all_wrong_statements_are_named(marker):
    mark = marker.mark("Q1.1", [False, True, False])
    assert mark.feedback == "0 of 3 statements right. Look again at statements 1, 2, 3."


def test_the_explanation_tells_every_truth_and_the_feedback_none(marker):
    mark = marker.mark("Q1.1", [False, False, False])
    assert mark.parts[0].explanation.startswith("True. At sea level")
    assert mark.parts[1].explanation.startswith("False. Ice is lighter")
    assert mark.full_explanation.startswith("- Statement 1: True. At sea level")
    assert mark.full_explanation.endswith("\n\nWater is an unusual liquid.")
    assert "Ice is lighter" not in mark.feedback + "".join(part.feedback for part in mark.parts)


def test_right_is_named_and_anything_else_is_no_alternative(marker):
    right = marker.mark("Q1.1", [True, False, True])
    assert (right.alternative, right.feedback) == ("right", "3 of 3 statements right.")
    assert marker.mark("Q1.1", [True, False, False]).alternative is None


@pytest.mark.parametrize(
    "response", [[True, False], [True] * 4, [1, 0, 1], ["true", "false", "true"], "tft", {}, 3]
)
def test_a_response_that_does_not_fit_is_unreadable(marker, response):
    assert marker.mark("Q1.1", response).status == "unreadable"
