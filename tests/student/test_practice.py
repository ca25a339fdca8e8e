"""Practice: fresh variants and functions to read, marked at once; boxes that remember."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_identity import KEY, STORY

from autograder import check, practise
from autograder.course import load_course
from autograder.marking.marker import Marker
from autograder.questions.registry import kind_of
from autograder.student.desk import Desk
from autograder.student.practice.boxes import BOXES, Card, draw, first_card
from autograder.student.practice.desk import PracticeDesk
from autograder.student.practice.round import SECONDS, Practice
from autograder.student.widgets.practice import PracticeWidget
from autograder.student.widgets.reading import ReadingWidget
from tests.toy import Toy

SOLUTIONS = '''

def counts_the_weights(weights):
    """Says how many there are."""
    return len(weights)


def heaviest_cases(rng):
    return [
        {"name": "two apples", "args": [[5, 3]]},
        {"name": "three apples", "args": [[9, 7, 4]]},
    ]
'''
MORE = """
[["Q4".alternative]]
name = "counts"
function = "orchard_reference:counts_the_weights"
credit = 0.25
feedback = "You count the apples instead of weighing them."
"""


@pytest.fixture
def pond(own_orchard: Path) -> Path:
    """The orchard with a question that has variants, and the key at hand."""
    return Toy(own_orchard).add("orchard", STORY, MORE + KEY, SOLUTIONS).root


def say(widget: Any, do: str, **message: Any) -> None:
    widget._receive(widget, {"seq": 1, "do": do, **message}, [])


def kept(root: Path, name: str = "orchard") -> dict[str, Any]:
    path = root / f"notebooks/responses/{name}.json"
    entries: dict[str, Any] = json.loads(path.read_text())["responses"]
    return entries


def test_another_one_has_other_numbers_names_the_mistake_and_leaves_the_answer(pond, sent):
    desk = Desk(load_course())
    question = desk.course.question("Q6")
    check("Q6", 6)
    before = kept(pond)
    widget = kind_of(question).widget(desk, question)
    assert widget.fixed["another"]
    seen = set()
    for _ in range(4):
        say(widget, "another")
        child = widget._practised
        assert sent[-1]["child"] == child.model_id
        assert not child.fixed["another"]
        numbers = child.desk.course.numbers("Q6")
        seen.add(tuple(numbers.values()))
        assert f"{numbers['fish']} fish" in child.fixed["prompt"]
        say(child, "check", text="fish")  # a name of the variant, not of the notebook
        assert child.state["mark"]["status"] == "partial"
        assert child.state["mark"]["feedback"] == f"Twice as many as {numbers['fish']}."
        assert child.state["mark"]["points"] == ""
        say(child, "check", text=str(2 * numbers["fish"]))
        assert child.state["mark"]["status"] == "right"
    assert (3, 0.5) not in seen
    assert len(seen) > 1
    assert kept(pond) == before


def test_without_the_key_there_is_no_other_one(pond, sent):
    (pond / "solutions").rename(pond / "elsewhere")
    desk = Desk(load_course())
    question = desk.course.question("Q6")
    assert not kind_of(question).widget(desk, question).fixed["another"]
    assert "nothing to practise" in repr(practise())


def test_functions_to_read_give_nothing_away_and_are_marked(pond):
    marker = Marker(load_course(), 3)
    rights = set()
    for seed in range(12):
        reading = marker.reading("Q4", seed)
        shown = reading.shown()
        assert "right" not in shown
        assert not any("Says how many" in code or "heaviest" in code for code in shown["codes"])
        spaces: dict[str, Any] = {}
        for code in shown["codes"]:
            exec(code, spaces)
        # What each of them does is found out by running it.
        assert {name: spaces[name]([9, 7, 4]) == 9 for name in "ABC"}["ABC"[reading.right]]
        assert str(eval(shown["call"], spaces)) == shown["values"][reading.returned]
        assert "ABC"[reading.right] != shown["called"]
        assert reading.mark(reading.right, reading.returned)["right"]
        wrong = reading.mark(reading.called, (reading.returned + 1) % 3)
        assert not wrong["right"]
        assert reading.remarks[reading.called] in wrong["said"]
        rights.add(reading.right)
    assert len(rights) > 1


def test_a_verdict_on_what_was_read_stands(pond, sent):
    desk = Desk(load_course())
    question = desk.course.question("Q4")
    widget = kind_of(question).widget(desk, question, len, None)
    say(widget, "another")
    child = widget._practised
    assert isinstance(child, ReadingWidget)
    say(child, "check", chosen=0, returned="x")
    assert sent[-1]["said"] == "Answer both parts."
    say(child, "check", chosen=0, returned=0)
    verdict = child.state["verdict"]
    say(child, "check", chosen=1, returned=1)
    assert child.state["verdict"] == verdict != {}


FORMULA = """
[[question]]
id = "Q7"
kind = "expression"
title = "Any number of fish"
points = 1
story = "pond"
variable = "frogs_of"
prompt = "Twice as many frogs as fish: a formula in $f$."
hints = ["Double."]
[question.symbols]
f = "fish"
"""
KEY_OF_FORMULA = """
["Q7"]
sample = {f = [1, 9]}
alternative = [
    {name = "right", credit = 1, expression = "2*f"},
    {name = "a number", credit = 0.25, expression = "{2*fish}", feedback = "Not {fish} fish only."},
    {name = "as many", credit = 0.25, expression = "f", feedback = "Twice as many."},
]
"""


def test_a_formula_that_nobody_has_answered_yet_is_not_practised(pond, sent):
    """Only its feedback has numbers: another one would ask the same, and tell its answer."""
    Toy(pond).add("orchard", FORMULA, KEY_OF_FORMULA)
    desk = Desk(load_course())
    assert "Q7" in desk.course.varied
    practised = [placed.question.id for placed in Practice(desk).placed()]
    assert "Q6" in practised
    assert "Q7" not in practised
    question = desk.course.question("Q7")
    assert not kind_of(question).widget(desk, question).fixed["another"]


def test_the_boxes_are_leitners():
    card = Card(1)
    for box in (2, 3, 4, 5, 5):
        card = card.after(True)
        assert card.box == box
    assert card.after(False) == Card(1, 6, 5)
    assert first_card({"status": "right", "attempts": 1}).box == 3
    assert first_card({"status": "right", "attempts": 2}).box == 1
    assert first_card(None).box == 2


def test_a_question_in_one_box_is_drawn_half_as_often_as_in_the_box_below():
    rng = np.random.default_rng(1)
    cards = {"low": Card(1), "high": Card(2)}
    drawn = [draw(cards, rng) for _ in range(3000)]
    assert abs(drawn.count("low") / 3000 - 2 / 3) < 0.04  # 4.6 standard deviations
    assert all(draw(cards, rng, "low") == "high" for _ in range(20))
    assert draw({"only": Card(BOXES)}, rng, "only") == "only"


def test_a_round_ends_after_ten_minutes_and_is_remembered(pond, sent):
    now = [0.0]
    desk = Desk(load_course())
    practice = Practice(desk, np.random.default_rng(4), clock=lambda: now[0])
    assert [placed.question.id for placed in practice.placed()] == ["Q6"]
    check("Q3", 0)  # answered, and wrong: it may be asked again
    widget = PracticeWidget(desk, practice)
    assert {row["id"]: row["box"] for row in widget.state["rows"]} == {"Q3": 1, "Q6": 2}
    say(widget, "start")
    for _ in range(6):
        child = practice.widget
        assert isinstance(child.desk, PracticeDesk)
        right = child.question.id == "Q6"
        fish = child.desk.course.numbers("Q6")["fish"]
        say(child, "check", text=str(2 * fish) if right else "w")
        moved = widget.state["rows"]
        assert widget.state["asked"] == practice.asked  # the picture follows at once
        say(child, "check", text="1")  # a second attempt moves nothing
        assert widget.state["rows"] == moved
        say(widget, "next")
        assert sent[-1]["child"] == practice.widget.model_id
    assert (practice.asked, widget.state["asked"]) == (6, 6)
    assert 0 < practice.right < 6
    now[0] = SECONDS + 1
    say(widget, "next")
    assert sent[-1]["child"] is None
    assert not widget.state["running"]
    boxes = {p.question.id: p.card for p in Practice(Desk(load_course())).placed()}
    assert boxes["Q3"].box == 1
    assert boxes["Q6"].box == min(5, 2 + boxes["Q6"].right)
    assert boxes["Q3"].asked + boxes["Q6"].asked == 6
    assert set(kept(pond, "practice")) == {"Q3", "Q6"}
    (pond / "notebooks/responses/practice.json").write_text('{"responses": {"Q6": {"box": 99}}}')
    assert Practice(desk).placed()[-1].card == Card(2)
