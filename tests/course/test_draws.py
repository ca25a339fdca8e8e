"""Statements drawn from a bank and cards dealt otherwise: the same with and without the key."""

from __future__ import annotations

import pytest

from autograder.authoring.proof_of_drawn_numbers import prove_variants
from autograder.errors import CourseError
from autograder.marking.marker import Marker
from tests.toy import Toy, make_toy

QUESTIONS = """
[[question]]
id = "Q7"
kind = "true_false"
title = "Salt"
prompt = "Two claims about salt."
statements = ["Salt is a mineral.", "Salt is sweet.", "Salt melts ice.", "Sweet things hold salt."]
draws = [[1, 2], [4, 3], [3, 2]]
hints = ["A salt mine.", "Taste it.", "A road in winter.", "Read a label."]

[[question]]
id = "Q8"
kind = "order"
title = "Bread"
points = 3
prompt = "Put the steps in order."
cards = [{id = "eat", text = "Eat"}, {id = "bake", text = "Bake"}, {id = "knead", text = "Knead"}]
draws = [[1, 2, 3], [2, 1, 3]]
hints = ["What comes last?"]
"""
ANSWERS = """
["Q7"]
statement = [
    {truth = true, explanation = "It is mined.", misconception = "Look at a mine."},
    {truth = false, explanation = "It is salty.", misconception = "Taste it.", topic = "taste"},
    {truth = true, explanation = "At -9 °C.", misconception = "Look at a road."},
    {truth = false, explanation = "Few do.", misconception = "Read on.", topic = "taste"},
]

["Q8"]
order = ["knead", "bake", "eat"]
before = [["knead", "bake"], ["bake", "eat"]]
"""
FILE = "notebooks/questions/kitchen.toml"


@pytest.fixture
def salted(tmp_path) -> Toy:
    return make_toy(tmp_path / "course").add("kitchen", QUESTIONS, ANSWERS)


def test_variant_0_is_the_sheets(salted):
    course = salted.load()
    question = course.question("Q7")
    assert question.statements == ("Salt is a mineral.", "Salt is sweet.")
    assert question.hints == ("A salt mine.", "Taste it.")
    assert question.points == 2
    assert [statement.truth for statement in course.key["Q7"].statements] == [True, False]
    assert course.question("Q8").start == ("eat", "bake", "knead")


def test_a_draw_takes_its_statements_hints_and_truths_along(salted):
    course = salted.load().with_variants({"Q7": 1, "Q8": 1})
    question = course.question("Q7")
    assert question.statements == ("Sweet things hold salt.", "Salt melts ice.")
    assert question.hints == ("Read a label.", "A road in winter.")
    assert course.question("Q8").start == ("bake", "eat", "knead")
    assert course.question("Q8").hints == ("What comes last?",)
    marker = Marker(course, 1)
    assert marker.mark("Q7", [False, True]).status == "right"
    wrong = marker.mark("Q7", [False, False])
    assert (wrong.points, wrong.parts[1].feedback) == (1, "Look at a road.")
    assert marker.mark("Q8", ["bake", "eat", "knead"]).status == "not attempted"
    assert marker.mark("Q8", ["knead", "bake", "eat"]).status == "right"


def test_sound_draws_are_proven(salted):
    assert list(prove_variants(salted.load())) == []


@pytest.mark.parametrize(
    ("old", "new", "problem"),
    [
        ("[3, 2]]", "[4, 2]]", "Q7 with draw = 2: all its statements are"),
        ("[3, 2]]", "[4, 2]]", "Q7 with draw = 2: two of its statements are about 'taste'"),
        ("[2, 1, 3]", "[3, 2, 1]", "Q8 with draw = 1: its cards are dealt in a right order"),
    ],
)
def test_a_poor_draw_is_named(salted, old, new, problem):
    salted.replace(FILE, old, new)
    assert problem in "\n".join(prove_variants(salted.load()))


@pytest.mark.parametrize(
    ("old", "new", "problem"),
    [
        ("[4, 3]", "[5, 3]", "draw 1 must hold numbers from 1 to 4"),
        ("[4, 3]", "[true, 3]", "draw 1 must hold numbers from 1 to 4"),
        ("[4, 3]", "[3, 3]", "draw 1 must name 2 different statements"),
        ("[4, 3]", "[3]", "draw 1 must name 2 different statements"),
        ("[4, 3]", "[3, 2]", "draw 2 is the same as another"),
        ("[4, 3]", "[1, 3]", "no draw has number 4 of statements"),
        ("[[1, 2], ", "[[2, 1], ", "the first draw is the sheet's"),
        ("[[1, 2], [4, 3], [3, 2]]", "[]", "draws are lists such as"),
        ("[[1, 2], [4, 3], [3, 2]]", "[[1, 2]]\nvariables = {w = [1]}", "remove them or draws"),
        ('statements = ["Salt is', 'statement = ["Salt is', "draws draw from statements"),
    ],
)
def test_draws_that_do_not_fit_are_refused(salted, old, new, problem):
    salted.replace(FILE, old, new)
    with pytest.raises(CourseError, match="Q7") as caught:
        salted.load()
    assert problem in str(caught.value)


def test_a_key_that_misses_a_statement_is_refused(salted):
    old = '    {truth = true, explanation = "At -9 °C.", misconception = "Look at a road."},\n'
    salted.replace("solutions/answers/kitchen.toml", old, "")
    with pytest.raises(CourseError, match=r"it has 4 statements, but its key 3 \[\[statement\]\]"):
        salted.load().key  # noqa: B018


def test_a_kind_without_a_list_has_nothing_to_draw_from(salted):
    salted.append(FILE, '[[question]]\nid = "Q9"\nkind = "number"\ndraws = [[1]]\n')
    with pytest.raises(CourseError, match="nothing to draw from"):
        salted.load()
