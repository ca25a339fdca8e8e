"""Without a key: what a snapshot tells is marked, and all else is recorded."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

from autograder.errors import CourseError
from autograder.kinds.expression.marking import hidden_points
from autograder.kinds.expression.snapshot import take_snapshot
from autograder.marking.snapshots import SnapshotMarker, recorded
from autograder.questions.json_arrays import pack
from autograder.questions.mark import Mark

RECORDED = "Recorded. It will be marked after you hand in."


@pytest.fixture
def course(toy):
    """The toy course with a snapshot of Q1.4 in one file, and of Q1.5, unchecked, in another."""
    course = toy.load()
    answer = course.key["Q1.4"]
    taken = take_snapshot(answer, hidden_points(answer, np.random.default_rng(1)))
    folder = toy.root / "notebooks/snapshots"
    folder.mkdir()
    (folder / "kitchen.json").write_text(json.dumps(pack({"Q1.4": taken})), encoding="utf-8")
    unchecked = {"Q1.5": {"checked": False, "cases": []}}
    (folder / "pantry.json").write_text(json.dumps(unchecked), encoding="utf-8")
    (folder / "notes.txt").write_text("no snapshot", encoding="utf-8")
    return course


def test_what_a_snapshot_tells_can_be_marked(course):
    marker = SnapshotMarker(course)
    assert marker.can_mark("Q1.4") is True
    assert marker.can_mark("Q1.5") is False  # it says that it is not to be checked
    assert marker.can_mark("Q1.3") is False


def test_a_probe_holds_the_points_of_the_snapshot_and_may_tell_everything(course):
    marker = SnapshotMarker(course)
    sent = marker.probe("Q1.4")
    assert sent["tell"] is True
    assert sent["kind"] == "expression"
    assert sent["points"]["a"].shape == (12,)
    assert marker.probe("Q1.3") == {"kind": "number", "tell": True}
    assert marker.probe("Q1.5") == {"kind": "function", "cases": [], "tell": True}


def test_values_are_marked_by_the_snapshot(course):
    marker = SnapshotMarker(course)
    points = marker.probe("Q1.4")["points"]
    right = marker.mark("Q1.4", {"state": "given", "values": 2 * (points["a"] + points["b"])})
    assert (right.status, right.points) == ("right", 4.0)
    wrong = marker.mark("Q1.4", {"state": "given", "values": points["a"]})
    assert wrong.status == "wrong"
    assert "Not equal yet." in wrong.feedback


@pytest.mark.parametrize("id", ["Q1.3", "Q1.4", "Q1.5"])
def test_untouched_work_is_not_attempted(course, id):
    mark = SnapshotMarker(course).mark(id, {"state": "not attempted"})
    assert (mark.status, mark.feedback) == ("not attempted", "Nothing was answered yet.")


@pytest.mark.parametrize("response", [None, 3, "given", ["given"]])
@pytest.mark.parametrize("id", ["Q1.3", "Q1.4"])
def test_what_is_no_reply_is_recorded(course, id, response):
    mark = SnapshotMarker(course).mark(id, response)
    assert (mark.status, mark.credit, mark.feedback) == ("recorded", 0.0, RECORDED)


@pytest.mark.parametrize("state", ["given", "raised", "unusable"])
@pytest.mark.parametrize("id", ["Q1.3", "Q1.5"])
def test_without_a_snapshot_everything_is_recorded(course, id, state):
    mark = SnapshotMarker(course).mark(id, {"state": state, "value": 12})
    assert (mark.status, mark.feedback) == ("recorded", RECORDED)


def test_what_the_question_alone_says_is_told_beside(course):
    said = f"{RECORDED} But a whole number is asked for, and this is not one."
    assert SnapshotMarker(course).mark("Q1.3", {"state": "given", "value": 1.5}).feedback == said
    question = course.question("Q1.3")
    assert recorded(question, {"value": 1.5}).feedback == said
    assert recorded(question, {"value": 2}) == Mark("Q1.3", "recorded", 0.0, 2.0, RECORDED)


def test_an_exception_is_told_where_the_snapshot_would_have_marked(course):
    mark = SnapshotMarker(course).mark("Q1.4", {"state": "raised", "error": "TypeError"})
    assert mark == Mark("Q1.4", "wrong", 0.0, 4.0, "Evaluating rim raises TypeError.")


@pytest.mark.parametrize(
    ("response", "why"),
    [
        ({"state": "unusable", "reason": "text"}, "it is a string; write it without quotes"),
        ({"state": "unusable", "reason": "unheard of"}, "it could not be read"),
        ({"state": "unusable"}, "it could not be read"),
        ({"reason": "not finite"}, "it is not a finite number"),
        ({"state": "unusable", "reason": ["text"]}, "it could not be read"),
    ],
)
def test_what_cannot_be_used_says_why(course, response, why):
    mark: Any = SnapshotMarker(course).mark("Q1.4", response)
    assert mark == Mark("Q1.4", "wrong", 0.0, 4.0, f"rim cannot be checked: {why}.")


@pytest.mark.parametrize("text", ["", "{", "[1]", "3", '{"Q1.4": {"complex": [1]}}'])
def test_a_damaged_snapshot_is_said_with_its_file(course, text):
    path = course.root / "notebooks/snapshots/pantry.json"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(CourseError) as caught:
        SnapshotMarker(course)
    assert str(caught.value) == (f"{path} is damaged; take it from the course's download again.")
