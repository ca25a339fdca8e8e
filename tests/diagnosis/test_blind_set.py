"""Wrong responses written blind get names, and the right ones."""

from __future__ import annotations

import pytest

from tests.diagnosis.blind import BlindMarker, name_of, read_blind_set

CHEAP = ("Q1.2", "Q1.7", "Q1.8", "Q2.4", "Q3.2", "Q3.3", "Q3.7")
# The author's own mistake of the key: an approximated logarithm gives the same number.
KNOWN = [("Q3.2.1", "one too many")]


def named(questions: tuple[str, ...]) -> list[tuple[object, str | None]]:
    marker = BlindMarker()
    wanted = [entry for entry in read_blind_set() if entry.question.startswith(questions)]
    return [(entry, name_of(marker.mark(entry.question, entry.given))) for entry in wanted]


def judge(found, least: float) -> None:
    rightly = [entry for entry, name in found if name in entry.expect]
    wrongly = [
        (entry.question, entry.error)
        for entry, name in found
        if name is not None and name not in entry.expect
    ]
    assert len(rightly) >= least * len(found)
    assert [entry for entry in wrongly if entry not in KNOWN] == []


def test_four_of_five_wrong_responses_have_a_name_that_says_what_is_wrong():
    judge(named(CHEAP), 0.8)


@pytest.mark.long
def test_four_of_five_of_all_of_them_have_one():
    judge(named(("Q",)), 0.8)
