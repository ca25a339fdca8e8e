"""The marker of a run: each question drawn once, each student's numbers, and other people's."""

from __future__ import annotations

import threading
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from typing import Any

import pytest

from autograder.errors import UsageError
from autograder.marking import marker as module
from autograder.marking.draw import seed_of_set, set_of_variant
from autograder.marking.marker import OTHER_NUMBERS, Marker
from autograder.questions.registry import kind_of
from tests.toy import Toy


def given(value: Any) -> dict[str, Any]:
    return {"state": "given", "value": value}


def test_sets_of_hidden_inputs_are_made_once_each(toy):
    marker = Marker(toy.load(), 7, tells=False)
    assert marker.with_set(0) is marker
    other, another = marker.with_set(1), marker.with_set(2)
    assert other is marker.with_set(1)
    assert (other.seed, another.seed) == (seed_of_set(7, 1), seed_of_set(7, 2))
    assert other.course is marker.course
    assert not other.drawn("Q1.3").tells


@pytest.mark.parametrize("tells", [True, False])
def test_a_question_is_drawn_once_with_what_stands_around_it(toy, tells):
    marker = Marker(toy.load(), 7, tells=tells)
    drawn = marker.drawn("Q1.5")
    assert marker.drawn("Q1.5") is drawn
    assert drawn.tells is tells
    assert Marker(marker.course, 7).drawn("Q1.5").tells
    near = marker.drawn("Q2.1").around.neighbors
    assert near == ()
    with pytest.raises(UsageError, match=r"Q9\.9"):
        marker.drawn("Q9.9")


def test_whichever_thread_asks_first_a_question_is_drawn_once(toy, monkeypatch):
    marker, asked, draw = Marker(toy.load(), 7), [], module.draw
    together = threading.Barrier(4)

    def slow(question: Any, *rest: Any) -> Any:
        asked.append(question.id)
        time.sleep(0.05)
        return draw(question, *rest)

    def ask(id: str) -> Any:
        together.wait()
        return marker.drawn(id)

    monkeypatch.setattr(module, "draw", slow)
    with ThreadPoolExecutor(4) as threads:
        first, *others = threads.map(ask, ["Q1.3"] * 4)
    assert asked == ["Q1.3"]
    assert all(other is first for other in others)


def test_what_is_prepared_is_drawn_before_anybody_asks(toy, monkeypatch):
    marker, asked, draw = Marker(toy.load(), 7), [], module.draw

    def counted(question: Any, *rest: Any) -> Any:
        asked.append(question.id)
        return draw(question, *rest)

    monkeypatch.setattr(module, "draw", counted)
    marker.prepare(["Q1.3", "Q1.1"])
    assert asked == ["Q1.3", "Q1.1"]
    marker.prepare()
    assert sorted(asked) == sorted(marker.course.questions)
    marker.drawn("Q1.5")
    assert len(asked) == len(marker.course.questions)


def test_a_students_marker_has_their_numbers_and_shares_all_else(market):
    marker = Marker(market.load(), 3, tells=False)
    ada = marker.for_student("ada")
    assert ada.course.variants == marker.course.for_student("ada").variants
    assert ada.drawn("Q1.5") is marker.drawn("Q1.5")
    assert ada.drawn("Q7") is not marker.drawn("Q7")
    assert not ada.drawn("Q7").tells
    assert (ada.seed, marker.for_student(" ")) == (3, marker)


WORDS = """
[[question]]
id = "Q7.3"
kind = "function"
title = "The mean of two"
points = 1
function = "mean_of"
prompt = "The mean of {a} and {a + 2} is {a + 1}."
hints = ["Add."]
variables = {a = [1, 2, 3, 4]}
"""
KEY_OF_WORDS = """
["Q7.3"]
reference = "solutions.kitchen:mean_weight"
cases = "solutions.kitchen:mean_weight_cases"
"""


def test_where_only_the_words_vary_few_sets_are_drawn_for_all(market):
    marker = Marker(market.add("kitchen", WORDS, KEY_OF_WORDS).load(), 3)
    sets = set()
    for name in ("ada", "bo", "cy", "dee", "eve", "fay"):
        own = marker.for_student(name)
        number = set_of_variant(own.course.variants["Q7.3"])
        assert own.drawn("Q7.3") is marker.with_set(number).drawn("Q7.3")
        sets.add(number)
    assert sets == {0, -1}


def test_a_variant_to_practise_has_a_marker_of_its_own(market):
    marker = Marker(market.load(), 3, tells=False)
    assert marker.of_variant("Q7", 0) is marker
    assert marker.of_variant("Q1.3", 0) is marker  # it has no others
    last = marker.of_variant("Q7", 19)
    assert marker.of_variant("Q7", 19) is last
    assert last.course.variants["Q7"] == 19
    assert (last.seed, last.drawn("Q7").tells) == (3, False)
    assert last.mark("Q7", given(4 * last.course.numbers("Q7")["boxes"])).status == "right"
    ada = marker.for_student("ada")
    own = ada.course.variants["Q7"]
    assert ada.of_variant("Q7", own) is ada
    other = ada.of_variant("Q7", (own + 1) % 20)
    assert other.course.variants == {**ada.course.variants, "Q7": (own + 1) % 20}


@pytest.mark.parametrize(
    ("id", "variant"), [("Q7", 20), ("Q7", -1), ("Q7", "1"), ("Q7", None), ("Q1.3", 1)]
)
def test_a_variant_that_there_is_not_is_said(market, id, variant):
    with pytest.raises(UsageError) as caught:
        Marker(market.load(), 3).of_variant(id, variant)
    assert str(caught.value) == f"{id} has no variant {variant!r}."


def test_functions_to_read_are_drawn_by_both_seeds(toy):
    course = toy.load()
    readings = [Marker(course, seed).reading("Q1.5", other) for seed, other in
                [(3, n) for n in range(12)] + [(n, 3) for n in range(12)]]  # fmt: skip
    assert readings[3] == readings[12 + 3]
    assert len({str(reading) for reading in readings[:12]}) > 2
    assert len({str(reading) for reading in readings[12:]}) > 2
    with pytest.raises(UsageError) as caught:
        Marker(course, 3).reading("Q1.3", 1)
    assert str(caught.value) == "There are no functions to read for Q1.3."


def test_functions_to_read_bear_no_name_that_the_course_asks_for(toy, monkeypatch):
    course = toy.load()
    told: list[Any] = []
    kind = type(kind_of(course.question("Q1.5")))
    monkeypatch.setattr(kind, "reading", lambda self, *given: told.append(given) or "functions")
    turned = replace(course, chapters=course.chapters[::-1])
    assert Marker(turned, 3).reading("Q1.5", 1) == "functions"
    ((question, answer, _, _, root, names),) = told
    assert (question, answer, root) == (course.question("Q1.5"), course.key["Q1.5"], course.root)
    assert names == ["share", "eggs", "rim", "mean_weight"]


def test_a_response_is_shown_as_it_was_before_anything_was_sent(toy):
    marker = Marker(toy.load(), 3)
    assert marker.mark("Q1.3", given(12), "12.0").understood == "12 eggs"
    assert marker.mark("Q1.3", given(12), "3.0").understood == "3 eggs"
    assert marker.mark("Q1.3", given(345)).understood == ""


def with_boxes(course: Toy, boxes: str) -> Marker:
    course.replace("notebooks/questions/kitchen.toml", "[3, 5, 7, 11]", boxes)
    return Marker(course.load(), 3)


def test_a_response_to_the_numbers_of_somebody_else_is_told_so(market):
    marker = with_boxes(market, "[30, 51, 77, 119]")
    ada = marker.for_student("ada")
    mine = ada.course.numbers("Q7")["boxes"]
    for boxes in (30, 51, 77, 119):
        mark = ada.mark("Q7", given(4 * boxes), "what was typed")
        if boxes == mine:
            assert mark.status == "right"
            continue
        assert (mark.status, mark.alternative, mark.credit) == ("wrong", OTHER_NUMBERS, 0)
        assert mark.feedback == (
            f"That is right for other numbers (boxes = {boxes}, price = 0.5); yours stand in "
            "the question."
        )
        assert mark.understood == "what was typed"
    # What has a name of its own is that, and what is right for nobody has none.
    assert ada.mark("Q7", given(4 + mine)).alternative == "added"
    assert ada.mark("Q7", given(1234567)).alternative not in (OTHER_NUMBERS, "right")


@pytest.mark.parametrize(("credit", "status"), [(0, "wrong"), (0.25, "partial")])
def test_a_mistake_with_ones_own_numbers_is_not_taken_for_other_numbers(market, credit, status):
    """9 boxes of 4 eggs are 36; so are 32 and 4."""
    answers = "solutions/answers/kitchen.toml"
    market.replace(
        answers, '"added", credit = 0.25, value = "4', f'"added", credit = {credit}, value = "4'
    )
    marker = with_boxes(market, "[9, 32]")
    names = (f"student {n}" for n in range(50))
    own = next(m for m in map(marker.for_student, names) if m.course.numbers("Q7")["boxes"] == 32)
    mark = own.mark("Q7", given(36))
    assert (mark.status, mark.alternative) == (status, "added")


def test_other_numbers_are_not_looked_for_where_everybody_has_the_sheets(market):
    market.replace("pyproject.toml", '"student"', '"sheet"')
    marker = with_boxes(market, "[30, 51, 77, 119]")
    assert marker.mark("Q7", given(4 * 119)).alternative != OTHER_NUMBERS


def test_other_numbers_are_not_looked_for_where_a_question_has_none(market, monkeypatch):
    market.add("kitchen", WORDS, KEY_OF_WORDS)
    marker = with_boxes(market, "[30, 51, 77, 119]").for_student("ada")
    tried: list[str] = []
    monkeypatch.setattr(Marker, "_of_other_numbers", lambda self, mark, *rest: tried.append(mark))
    # Where only the words vary, a right response is right for everybody.
    outcomes = {"state": "given", "outcomes": [{"value": value} for value in (1.5, 2.6, 3.8, 4.1)]}
    for id, response in (("Q1.3", given(98765)), ("Q7.3", outcomes)):
        assert marker.mark(id, response).status == "wrong"
    assert tried == []
    assert marker.mark("Q7", given(98765)).status == "wrong"  # and None is no other mark
    assert len(tried) == 1


def test_the_variants_of_a_question_are_drawn_once_for_all_students(market, monkeypatch):
    marker, asked, draw = with_boxes(market, "[30, 51, 77, 119]"), [], module.draw

    def counted(question: Any, *rest: Any) -> Any:
        asked.append(question.prompt)
        return draw(question, *rest)

    for name in ("ada", "bo"):
        marker.for_student(name).mark("Q7", given(98765))
        monkeypatch.setattr(module, "draw", counted)
    assert len(asked) == 1  # Bo's own


def test_no_more_variants_are_tried_than_time_allows(market, monkeypatch):
    monkeypatch.setattr(module, "MOST_TRIED", 2)
    marker = with_boxes(market, "[30, 51, 77, 119]")
    numbers = [marker.course.varied["Q7"].variables.numbers(n)["boxes"] for n in range(20)]
    names = (f"student {n}" for n in range(50))
    own = next(m for m in map(marker.for_student, names)
               if m.course.numbers("Q7")["boxes"] not in numbers[:3])  # fmt: skip
    found = {n: own.mark("Q7", given(4 * numbers[n])).alternative for n in (0, 1)}
    assert set(found.values()) == {OTHER_NUMBERS}
    later = next(
        n for n in numbers[2:] if n not in (*numbers[:2], own.course.numbers("Q7")["boxes"])
    )
    assert own.mark("Q7", given(4 * later)).alternative != OTHER_NUMBERS
