"""Questions that are answered by a choice: `ask` and `respond`."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from autograder import ask, check
from autograder.student.views import RECEIPT


def test_a_question_shows_its_prompt_and_statements(orchard: Path):
    text = repr(ask("Q1"))
    assert "Which of these $n = 2$ claims hold?" in text
    assert "1. An apple tree has cones." in text
    assert "2. A cherry tree has blossoms." in text


def test_every_statement_called_right_earns_all_points(orchard: Path):
    mark = ask("Q1").respond([False, True]).mark
    assert (mark.status, mark.points) == ("right", 2)


def test_a_wrong_statement_gets_feedback_of_its_own(orchard: Path):
    shown = ask("Q1").respond([True, True])
    assert (shown.mark.status, shown.mark.points) == ("partial", 1)
    assert "look for needles" in repr(shown)
    assert "shake one" not in repr(shown)


def test_a_statement_may_be_left_open(orchard: Path):
    mark = ask("Q1").respond([None, True]).mark
    assert (mark.status, mark.points) == ("partial", 1)


def test_statements_all_left_open_are_not_attempted(orchard: Path):
    assert ask("Q1").respond([None, None]).mark.status == "not attempted"


def test_what_was_answered_is_shown_when_the_question_is_asked_again(orchard: Path):
    ask("Q1").respond([False, None])
    assert "An apple tree has cones. → false" in repr(ask("Q1"))
    assert "A cherry tree has blossoms. →" not in repr(ask("Q1"))


def test_an_order_may_be_given_by_ids_or_by_the_numbers_shown(orchard: Path):
    by_id = ask("Q5").respond(["sow", "water", "eat"]).mark
    by_number = ask("Q5").respond([2, 3, 1]).mark
    assert (by_id.status, by_id.points) == ("right", 3)
    assert by_number == by_id


def test_a_response_may_be_an_array(orchard: Path):
    assert ask("Q5").respond(np.array([2, 3, 1])).mark.status == "right"
    assert ask("Q5").respond([np.int64(2), np.int64(3), np.int64(1)]).mark.status == "right"
    assert ask("Q5").respond(np.array(["sow", "water", "eat"])).mark.status == "right"
    assert ask("Q1").respond(np.array([1, 2]) > 1).mark.status == "right"
    assert ask("Q1").respond((np.False_, np.True_)).mark.status == "right"


def test_one_card_to_move_costs_two_thirds_of_three_cards(orchard: Path):
    mark = ask("Q5").respond(["water", "sow", "eat"]).mark
    assert (mark.status, mark.points) == ("partial", 1)


def test_the_cards_as_dealt_are_not_attempted(orchard: Path):
    assert ask("Q5").respond([1, 2, 3]).mark.status == "not attempted"


def test_an_order_question_shows_its_cards_with_numbers_and_then_the_order_given(orchard: Path):
    assert "1. Eat the apple" in repr(ask("Q5"))
    ask("Q5").respond(["sow", "water", "eat"])
    assert "Sow the pip › Water the tree › Eat the apple" in repr(ask("Q5"))


@pytest.mark.parametrize(
    "response",
    [
        [True],
        [True, "no"],
        [1, 0],
        "True, True",
        None,
        42,
        {True: False},
        [[True, True]],
    ],
)
def test_a_response_that_is_no_list_of_truth_values_gets_one_sentence(
    orchard: Path, capsys: pytest.CaptureFixture[str], response: object
):
    ask("Q1").respond([False, True])
    assert ask("Q1").respond(response) is None
    said = capsys.readouterr().out
    assert said.count("\n") == 1
    assert "respond with a list of 2 True or False" in said
    assert check("Q1").mark.status == "right"  # what was there is still there


@pytest.mark.parametrize(
    "response",
    [
        ["sow", "water"],
        [1, 2, 2],
        [0, 1, 2],
        [1, 2, 4],
        ["sow", "water", "run"],
        "sow",
        None,
        [True] * 3,
    ],
)
def test_an_order_that_does_not_name_each_card_once_gets_one_sentence(
    orchard: Path, capsys: pytest.CaptureFixture[str], response: object
):
    assert ask("Q5").respond(response) is None
    said = capsys.readouterr().out
    assert said.count("\n") == 1
    assert "names each card once" in said
    assert not (orchard / "orchard.json").exists()


def test_check_without_a_response_marks_what_was_answered(orchard: Path):
    assert check("Q1").mark.status == "not attempted"
    ask("Q1").respond([False, True])
    assert check("Q1").mark.status == "right"


def test_the_output_carries_a_receipt_that_the_grader_can_read(orchard: Path):
    shown = ask("Q1").respond([True, None])
    for view in (shown, ask("Q1")):
        bundle = view._repr_mimebundle_()
        assert json.loads(json.dumps(bundle[RECEIPT])) == {
            "question": "Q1",
            "response": [True, None],
        }


def test_an_unanswered_question_leaves_no_receipt(orchard: Path):
    assert RECEIPT not in ask("Q1")._repr_mimebundle_()


def test_outputs_are_the_same_in_every_run_and_hold_no_address(orchard: Path):
    first = ask("Q1").respond([True, True])._repr_mimebundle_()
    second = ask("Q1").respond([True, True])._repr_mimebundle_()
    assert first == second
    for kind in ("text/plain", "text/markdown"):
        assert " at 0x" not in first[kind]
