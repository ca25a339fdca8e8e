"""A throwaway course about a garden, with one question of each kind, for the student's side."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import pytest

from autograder.student.widgets.base import CourseWidget

QUESTIONS = """
title = "The garden"

[[question]]
id = "Q1.1"
kind = "true_false"
title = "Plants"
prompt = "Which of these $n = 2$ claims hold?"
statements = ["A fern has flowers.", "An oak has acorns."]
hints = ["Look under a fern's leaf.", "Look under an oak."]

[[question]]
id = "Q1.2"
kind = "order"
points = 3
title = "Growing a bean"
prompt = "Put the steps in order."
cards = [
    {id = "eat", text = "Eat the bean"},
    {id = "sow", text = "Sow the bean"},
    {id = "water", text = "Water the bean"},
]
hints = ["What comes first?"]

[[question]]
id = "Q1.3"
kind = "number"
points = 2
variable = "bed_area"
integer = true
unit = "square metres"
title = "The bed"
prompt = "A bed is 3 m by 4 m. How large is it?"
hints = ["Width times length."]

[[question]]
id = "Q1.4"
kind = "expression"
points = 2
variable = "fence"
title = "The fence"
prompt = "How long is the fence around a bed of width $w$ and length $l$?"
hints = ["It has four sides."]
[question.symbols]
w = "width"
l = "length"

[[question]]
id = "Q1.5"
kind = "function"
points = 4
function = "harvest"
title = "The harvest"
prompt = "Add up the baskets."
hints = ["What does an empty list add up to?"]
"""

ANSWERS = """
["Q1.1"]
explanation = "Ferns have spores."
[["Q1.1".statement]]
truth = false
explanation = "Ferns are older than flowers."
misconception = "You may be thinking of a flower bed: look for seeds on the fern."
[["Q1.1".statement]]
truth = true
explanation = "That is where oaks come from."
misconception = "Acorns grow on oaks: shake one."

["Q1.2"]
order = ["sow", "water", "eat"]
before = [["sow", "water"], ["water", "eat"]]
explanation = "Nothing is eaten before it has grown."

["Q1.3"]
code = "3 * 4"
explanation = "An area is a product."
[["Q1.3".alternative]]
name = "right"
value = 12
credit = 1.0
[["Q1.3".alternative]]
name = "half the fence"
value = 7
credit = 0.25
feedback = "That is the sum of the sides: multiply them."

["Q1.4"]
code = "2 * (w + l)"
explanation = "Each side stands twice."
sample = {w = [1, 5], l = [1, 5]}
[["Q1.4".alternative]]
name = "right"
expression = "2*w + 2*l"
credit = 1.0
[["Q1.4".alternative]]
name = "each side once"
expression = "w + l"
credit = 0.5
feedback = "You walked along two sides only."

["Q1.5"]
reference = "solutions.garden:harvest"
cases = "solutions.garden:harvest_cases"
explanation = "A sum."
[["Q1.5".alternative]]
name = "forgets the first basket"
function = "solutions.garden:forgets_the_first"
credit = 0.5
feedback = "The first basket is missing from your sum."
"""

SOLUTIONS = '''
def harvest(baskets):
    """Add up the baskets."""
    return sum(baskets)


def forgets_the_first(baskets):
    return sum(baskets[1:])


def harvest_cases(rng):
    return [
        {"name": "no basket", "args": [[]]},
        {"name": "a few baskets", "args": [[int(n) for n in rng.integers(1, 50, 5)]]},
    ]
'''

NOTEBOOK = {
    "nbformat": 4,
    "nbformat_minor": 5,
    "metadata": {},
    "cells": [
        {
            "cell_type": "code",
            "id": "ask",
            "metadata": {},
            "execution_count": None,
            "outputs": [],
            "source": 'ask("Q1.1")',
        }
    ],
}


@pytest.fixture(scope="session")
def garden_template(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = tmp_path_factory.mktemp("garden")
    (root / "notebooks/questions").mkdir(parents=True)
    (root / "notebooks/questions/garden.toml").write_text(QUESTIONS)
    (root / "notebooks/1_garden.ipynb").write_text(json.dumps(NOTEBOOK))
    (root / "solutions/answers").mkdir(parents=True)
    (root / "solutions/answers/garden.toml").write_text(ANSWERS)
    (root / "solutions/__init__.py").write_text("")
    (root / "solutions/garden.py").write_text(SOLUTIONS)
    return root


@pytest.fixture
def garden(garden_template: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The course with its key; responses go to a folder of the test's own.

    Returns the folder of the responses. The course itself is shared, so that its marker is too.
    """
    monkeypatch.setenv("AUTOGRADER_COURSE", str(garden_template))
    monkeypatch.setenv("AUTOGRADER_RESPONSES", str(tmp_path / "responses"))
    monkeypatch.chdir(tmp_path)
    return tmp_path / "responses"


@pytest.fixture
def own_garden(garden_template: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of the course that the test may change, with the working folder in its notebooks."""
    root = tmp_path / "course"
    shutil.copytree(garden_template, root)
    monkeypatch.delenv("AUTOGRADER_COURSE", raising=False)
    monkeypatch.delenv("AUTOGRADER_RESPONSES", raising=False)
    monkeypatch.chdir(root / "notebooks")
    return root


@pytest.fixture
def bundle(own_garden: Path) -> Path:
    """A student bundle: the course without its solutions."""
    shutil.rmtree(own_garden / "solutions")
    return own_garden


@pytest.fixture
def sent(monkeypatch: pytest.MonkeyPatch) -> list[dict[str, Any]]:
    """What the widgets reply."""
    replies: list[dict[str, Any]] = []
    monkeypatch.setattr(CourseWidget, "send", lambda self, reply: replies.append(reply))
    return replies
