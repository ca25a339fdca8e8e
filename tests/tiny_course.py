"""A small, sound course in a folder of its own: every kind of question, two chapters, a key.

Tests break it on purpose, one thing at a time.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from autograder.authoring.build import (
    build_student_notebooks,
    unexecuted_solved_notebooks,
    write,
)
from autograder.course import Course, load_course

KITCHEN_QUESTIONS = """
title = "The kitchen"

[[question]]
id = "Q1.1"
kind = "true_false"
title = "Water"
prompt = "Three claims about water at sea level."
statements = ["Water boils at 100 °C.", "Ice sinks in water.", "Salt lowers the freezing point."]
hints = ["Put an ice cube into a glass."]

[[question]]
id = "Q1.2"
kind = "order"
title = "A pot of tea"
points = 5
prompt = "Put the steps in order. One step occurs twice."
cards = [
    {id = "drink", text = "Drink"},
    {id = "stir", text = "Stir"},
    {id = "boil", text = "Boil the water"},
    {id = "stir_again", text = "Stir"},
    {id = "pour", text = "Pour the water on the leaves"},
    {id = "cup", text = "Fetch a cup"},
]
hints = ["What needs hot water?"]

[[question]]
id = "Q1.3"
kind = "number"
title = "Eggs"
points = 2
variable = "eggs"
integer = true
unit = "eggs"
prompt = "Three boxes of four eggs: how many eggs?"
hints = ["Count one box first."]

[[question]]
id = "Q1.4"
kind = "expression"
title = "A tray"
points = 4
variable = "rim"
prompt = "How long is the rim of a tray of the given sides?"
hints = ["Walk around it."]
[question.symbols]
a = "one side"
b = "the other side"
half = "half of the rim, $a + b$"

[[question]]
id = "Q1.5"
kind = "function"
title = "The mean weight"
points = 4
function = "mean_weight"
prompt = "Write a function for the mean of some weights."
hints = ["Divide by what?"]
"""

KITCHEN_ANSWERS = """
["Q1.1"]
explanation = "Water is an unusual liquid."
[["Q1.1".statement]]
truth = true
explanation = "At sea level, at normal pressure."
misconception = "Perhaps you thought of a mountain: look at the pressure."
[["Q1.1".statement]]
truth = false
explanation = "Ice is lighter than water."
misconception = "Most solids sink in their liquid; look at a lake in winter."
[["Q1.1".statement]]
truth = true
explanation = "That is why roads are salted."
misconception = "Think of a road in winter, and of what is strewn on it."

["Q1.2"]
order = ["cup", "boil", "stir", "pour", "stir_again", "drink"]
before = [
    ["boil", "stir"],
    ["stir", "pour"],
    ["pour", "stir_again"],
    ["stir_again", "drink"],
    ["cup", "drink"],
]
interchangeable = [["stir", "stir_again"]]
explanation = "Hot water first, and a cup before the last step."
[["Q1.2".alternative]]
name = "cold water"
first = "pour"
second = "boil"
feedback = "You pour before the water is hot; boil it first."
[["Q1.2".alternative]]
name = "an empty cup"
first = "drink"
second = "pour"
feedback = "You drink before anything is in the pot; pour first."

["Q1.3"]
code = "3 * 4"
explanation = "Three times four eggs."
[["Q1.3".alternative]]
name = "right"
value = 12
credit = 1.0
[["Q1.3".alternative]]
name = "added"
value = 7
credit = 0.25
feedback = "You added boxes and eggs; every box holds four, so multiply."
[["Q1.3".alternative]]
name = "one box"
value = 4
credit = 0.0
feedback = "That is one box; there are three of them."

["Q1.4"]
code = "2 * (a + b)"
explanation = "Two sides of either length."
sample = {a = [1.0, 5.0], b = [1.0, 5.0]}
derived = {half = "a + b"}
[["Q1.4".alternative]]
name = "right"
expression = "2*a + 2*b"
credit = 1.0
[["Q1.4".alternative]]
name = "half the rim"
expression = "a + b"
credit = 0.5
feedback = "You walked along two sides only; there are four."
[["Q1.4".alternative]]
name = "the area"
expression = "a*b"
credit = 0.0
feedback = "That is the area; the rim is a length."

["Q1.5"]
reference = "solutions.kitchen:mean_weight"
cases = "solutions.kitchen:mean_weight_cases"
explanation = "The sum divided by the number."
[["Q1.5".alternative]]
name = "the sum"
function = "solutions.kitchen:total_weight"
credit = 0.25
feedback = "You return the sum; divide it by the number of weights."
[["Q1.5".alternative]]
name = "the middle"
function = "solutions.kitchen:middle_weight"
credit = 0.5
feedback = "You return the median; a heavy piece counts fully in the mean."
"""

CELLAR_QUESTIONS = """
title = "The cellar"

[[question]]
id = "Q2.1"
kind = "number"
title = "A shelf"
points = 1
variable = "share"
decimals = 2
prompt = "Two of six jars are open. Which share is that?"
hints = ["Open ones over all."]
"""

CELLAR_ANSWERS = """
["Q2.1"]
code = "2 / 6"
explanation = "A third."
[["Q2.1".alternative]]
name = "right"
value = 0.3333333
credit = 1.0
[["Q2.1".alternative]]
name = "the closed ones"
value = 0.6666667
credit = 0.5
feedback = "That is the share of the closed jars; count the open ones."
[["Q2.1".alternative]]
name = "open to closed"
value = 0.5
credit = 0.25
feedback = "You divided by the closed jars; divide by all of them."
"""

KITCHEN_SOLUTIONS = '''
"""The right mean, the wrong ones, and the weights to try them on."""

import numpy as np


def mean_weight(weights):
    """Return the mean of `weights`, a list of numbers in grams; 0 for none."""
    if len(weights) == 0:
        return 0.0
    total = sum(weights)
    return total / len(weights)


def total_weight(weights):
    return float(sum(weights))


def middle_weight(weights):
    return float(np.median(weights)) if len(weights) else 0.0


def mean_weight_cases(rng):
    return [
        {"name": "no weights", "args": [[]]},
        {"name": "two equal weights", "args": [[3.0, 3.0]], "public": True},
        {"name": "many weights", "args": [list(map(float, rng.uniform(1, 9, 5)))]},
        {"name": "one heavy weight", "args": [[1.0, 2.0, float(rng.uniform(50, 90))]]},
    ]
'''

KITCHEN_MASTER = """# %% [markdown]
# # The kitchen
#
# Everything that follows happens at sea level.

# %%
import numpy as np
import sympy as sp

from autograder import ask, check, progress, submit

# %% exercise="Q1.1"

# %% exercise="Q1.2"

# %% [markdown]
# Now some numbers.

# %% exercise="Q1.3"

# %%
a, b, half = sp.symbols("a b half")

# %% exercise="Q1.4"

# %% exercise="Q1.5"
"""

CELLAR_MASTER = """# %% [markdown]
# # The cellar

# %%
from autograder import ask, check, progress, submit

# %% exercise="Q2.1"
"""

SETTINGS = """
[tool.autograder]
notebook_seconds = 60
question_seconds = 20
"""

FILES = {
    "pyproject.toml": SETTINGS,
    "notebooks/questions/kitchen.toml": KITCHEN_QUESTIONS,
    "notebooks/questions/cellar.toml": CELLAR_QUESTIONS,
    "notebooks/source/1_kitchen.py": KITCHEN_MASTER,
    "notebooks/source/2_cellar.py": CELLAR_MASTER,
    "solutions/__init__.py": "",
    "solutions/answers/kitchen.toml": KITCHEN_ANSWERS,
    "solutions/answers/cellar.toml": CELLAR_ANSWERS,
    "solutions/kitchen.py": KITCHEN_SOLUTIONS,
}


@dataclass(frozen=True)
class TinyCourse:
    """A course of six questions and 19 points under ``root``, to be used or broken."""

    root: Path

    def load(self) -> Course:
        return load_course(self.root)

    def replace(self, file: str, old: str, new: str) -> None:
        """Change one place of one file; the place must be there exactly once."""
        path = self.root / file
        text = path.read_text(encoding="utf-8")
        assert text.count(old) == 1, f"{old!r} stands {text.count(old)} times in {file}"
        path.write_text(text.replace(old, new), encoding="utf-8")

    def append(self, file: str, text: str) -> None:
        with (self.root / file).open("a", encoding="utf-8") as stream:
            stream.write(text)

    def write_notebooks(self) -> None:
        """Build the student notebooks, and the solved ones without running them."""
        course = self.load()
        write(build_student_notebooks(course))
        write(unexecuted_solved_notebooks(course))

    def solved_cells(self, stem: str) -> list[dict[str, Any]]:
        """The cells of a solved notebook, as JSON."""
        text = (self.root / "solutions/notebooks" / f"{stem}.ipynb").read_text(encoding="utf-8")
        cells: list[dict[str, Any]] = json.loads(text)["cells"]
        return cells


def make_tiny_course(root: Path) -> TinyCourse:
    """Write the course's sources; its notebooks are not built yet."""
    for name, text in FILES.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return TinyCourse(root)
