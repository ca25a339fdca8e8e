"""In a student bundle there is no key: responses are recorded, and none looks marked."""

from __future__ import annotations

from pathlib import Path

import pytest

from autograder import ask, check, progress, submit
from autograder.student.responses import Responses


def stub(weights):
    raise NotImplementedError


@pytest.mark.parametrize(
    ("id", "response"),
    [
        ("Q1", [True, True]),
        ("Q5", ["sow", "water", "eat"]),
        ("Q2", 12),
        ("Q3", 12),
        ("Q4", max),
    ],
)
def test_every_response_is_recorded_and_earns_no_points_yet(
    bundle: Path, id: str, response: object
):
    shown = ask(id).respond(response)
    assert shown.mark.status == "recorded"
    assert "of" not in repr(shown).splitlines()[0]
    entry = Responses(bundle / "notebooks/responses", "orchard").get(id)
    assert (entry["status"], entry["points"]) == ("recorded", 0)


@pytest.mark.parametrize(
    ("id", "response"),
    [("Q1", [None, None]), ("Q5", [1, 2, 3]), ("Q2", ...), ("Q3", ...), ("Q4", stub)],
)
def test_untouched_work_is_not_attempted_without_a_key_too(bundle: Path, id: str, response: object):
    assert ask(id).respond(response).mark.status == "not attempted"


def test_what_was_recorded_counts_as_answered(bundle: Path):
    check("Q2", 12)
    assert "1 of 5" in repr(progress())
    assert "Unanswered or not checked: 4 of 5" in repr(submit())
