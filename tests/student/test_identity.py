"""Who a student is: asked by a field, shown below each question, and the reason for the numbers."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from nbformat import reads

from autograder import ask, check, me, numbers, predict
from autograder.authoring.build import build_student_notebooks
from autograder.course import load_course
from autograder.student.desk import Desk
from autograder.student.widgets.identity import IdentityWidget
from tests.toy import Toy

STORY = """
[story.pond]
fish = [3, 5, 7, 11, 13, 17]
share = [0.5, 0.25]

[[question]]
id = "Q6"
kind = "number"
title = "Frogs"
points = 2
story = "pond"
variable = "frogs"
integer = true
prompt = "{fish} fish and twice as many frogs: how many frogs?"
hints = ["Double."]

[[prediction]]
id = "P1.1"
story = "pond"
prompt = "How many legs have the {fish} fish?"
between = [0, 100]
"""
KEY = """
["Q6"]
code = "2 * fish"
alternative = [
    {name = "right", credit = 1, value = "2*fish"},
    {name = "as many", credit = 0.25, value = "fish", feedback = "Twice as many as {fish}."},
]
"""
MASTER = """# %%
me()

# %%
fish, share = numbers("pond")

# %% exercise="Q6"
"""


@pytest.fixture
def pond(own_orchard: Path) -> Path:
    """The orchard with numbers of everybody's own; the working folder is that of its notebooks."""
    return Toy(own_orchard).add("orchard", STORY, KEY).set('variants = "student"').root


def of(name: str) -> dict[str, Any]:
    return load_course().for_student(name).numbers("Q6") or {}


def test_a_notebook_has_the_numbers_of_whoever_it_belongs_to(pond: Path, capsys):
    assert tuple(numbers("pond")) == (3, 0.5)
    for name in ("Ada Lovelace", "boole", "12-345-678"):
        me(name)
        fish, _ = numbers("pond")
        assert (fish, numbers("pond").share) == tuple(of(name).values())
        assert f"{fish} fish" in repr(ask("Q6"))
        assert f"the {fish} fish" in repr(predict("P1.1"))
        assert check("Q6", 2 * fish).mark.status == "right"
    assert len({tuple(of(name).values()) for name in ("Ada Lovelace", "boole", "kepler")}) > 1
    capsys.readouterr()
    assert numbers("lake") is None
    assert capsys.readouterr().out == "There is no story 'lake'; this course has pond.\n"


def test_the_foot_of_a_question_says_whose_numbers_it_has(pond: Path):
    assert "the sheet's numbers" in repr(ask("Q6"))
    assert "sheet" not in repr(ask("Q1"))
    me("Ada Lovelace")
    assert repr(ask("Q6")).endswith("Answered by Ada Lovelace, whose own numbers these are.")
    assert repr(ask("Q1")).endswith("Answered by Ada Lovelace.")


def test_where_all_have_the_sheets_numbers_the_foot_names_only_the_student(pond: Path):
    (pond / "pyproject.toml").write_text("")
    me("boole")
    assert repr(ask("Q6")).endswith("Answered by boole.")
    assert tuple(numbers("pond")) == (3, 0.5)


def test_another_name_is_kept_only_after_a_warning(pond: Path, sent):
    widget = IdentityWidget(Desk(load_course()))

    def say(**message: Any) -> dict[str, Any]:
        widget._receive(widget, {"seq": 1, "do": "say", **message}, [])
        return sent[-1]

    assert "You are Ada Lovelace." in say(name=" Ada  Lovelace ")["told"]
    assert "warning" not in say(name="ada lovelace")
    assert "other numbers" in say(name="George Boole")["warning"]
    assert widget.state["name"] == "ada lovelace"
    assert "answer it again" in say(name="George Boole", sure=True)["told"]
    assert widget.state["name"] == "George Boole"
    refused = say(name="\n")
    assert (refused["ok"], widget.state["name"]) == (False, "George Boole")
    kept = json.loads((pond / "notebooks/responses/student.json").read_text())
    assert kept["responses"]["student"]["response"] == "George Boole"


def test_no_number_is_written_into_a_notebook_that_goes_to_everybody(pond: Path):
    ids = ["Q1", "Q2", "Q3", "Q4", "Q5"]
    others = "".join(f'\n# %% exercise="{id}"\n' for id in ids)
    asked = '\n# %%\npredict("P1.1")\n'
    (pond / "notebooks/source/3_orchard.py").write_text(MASTER + others + asked)
    built = reads(build_student_notebooks(load_course())[0].text, 4).cells
    first, cell = built[0].source, {cell.id: cell.source for cell in built}
    assert "import ask, check, hint, me, numbers, predict, predicted, progress, submit" in first
    assert cell["Q6-question"] == "### Q6 · Frogs\n\n*2 points*"
    assert cell["Q6-ask"] == 'ask("Q6")'
    assert "Three" in cell["Q2-question"] or "Q2-ask" not in cell
    (pond / "pyproject.toml").write_text("")
    cell = {c.id: c.source for c in reads(build_student_notebooks(load_course())[0].text, 4).cells}
    assert "3 fish and twice as many frogs" in cell["Q6-question"]
    assert "Q6-ask" not in cell
