"""What stands around a question: its neighbors of one kind, and the numbers of its chapter."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from autograder.marking.neighbors import around
from autograder.questions.drawn import Around


def write_notebook(root: Path, name: str, *sources: str, kind: str = "code") -> None:
    cells = [{"cell_type": kind, "source": source.splitlines(keepends=True)} for source in sources]
    path = root / "notebooks" / f"{name}.ipynb"
    cells.insert(1, {"cell_type": "markdown", "source": ["w = 99"]})
    path.write_text(json.dumps({"cells": cells}), encoding="utf-8")


def test_neighbors_are_the_others_of_one_kind_in_the_chapter(market):
    course = market.load()
    found = around(course, course.question("Q7")).neighbors
    assert [(question.id, key.id) for question, key in found] == [
        ("Q1.3", "Q1.3"), ("Q7.1", "Q7.1"), ("Q7.2", "Q7.2"),
    ]  # fmt: skip
    assert all(key is course.key[question.id] for question, key in found)
    assert around(course, course.question("Q1.4")).neighbors == ()
    assert around(course, course.question("Q2.1")).neighbors == ()
    elsewhere = replace_chapter(course.question("Q1.3"), "attic")
    assert around(course, elsewhere) == Around()


QUESTION = """
[[question]]
id = "Q2.2"
kind = "number"
title = "Another shelf"
points = 1
variable = "other_share"
decimals = 2
prompt = "One of four jars is open. Which share is that?"
hints = ["Open ones over all."]
"""
KEY = """
["Q2.2"]
code = "1 / 4"
alternative = [{name = "right", credit = 1, value = 0.25}]
"""


def test_the_first_question_of_the_last_chapter_is_a_neighbor_too(toy):
    course = toy.add("cellar", QUESTION, KEY).load()
    found = around(course, course.question("Q2.2")).neighbors
    assert [question.id for question, _ in found] == ["Q2.1"]


def replace_chapter(question, chapter):
    fields = {name: getattr(question, name) for name in question.__struct_fields__}
    return type(question)(**{**fields, "chapter": chapter})


@pytest.mark.parametrize("name", ["kitchen", "1_kitchen", "old_1_kitchen"])
def test_numbers_are_those_that_the_chapters_notebook_gives_to_names(toy, name):
    write_notebook(
        toy.root,
        name,
        "a = 3\nb = 0.25\na = 4\n",
        "%pip install numpy\nc = 5\n",
        "d = True\ne = 'x'\nf = g = 6\nh, i = 7, 8\nj: int = 9\nk += 1\nl = 2 * 5\nprint(a)",
        "if a:\n    n = 10\n",
        "b = 1\no = 11",
    )
    write_notebook(toy.root, "2_cellar", "%pip install numpy", "p = 12")
    write_notebook(toy.root, "kitchen2", "q = 13")
    course = toy.load()
    assert around(course, course.question("Q1.3")).numbers == {"a": 3, "b": 0.25, "o": 11}
    assert around(course, course.question("Q2.1")).numbers == {"p": 12}


def test_several_notebooks_of_a_chapter_are_read_in_their_order(toy):
    write_notebook(toy.root, "1_kitchen", "a = 1")
    write_notebook(toy.root, "2_kitchen", "a = 2\nb = 3")
    course = toy.load()
    assert around(course, course.question("Q1.3")).numbers == {"a": 1, "b": 3}


def test_the_question_s_own_numbers_come_before_those_of_the_notebook(market):
    write_notebook(market.root, "1_kitchen", "boxes = 99\nshelves = 2")
    course = market.load().with_variants({"Q7": 1})
    numbers = around(course, course.question("Q7")).numbers
    assert numbers == {"shelves": 2, **course.numbers("Q7")}
    assert numbers["boxes"] != 99
