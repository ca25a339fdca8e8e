"""The orchard with cards to move, so with one question of each kind, for the student's side."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import pytest

from autograder.student.widgets.base import CourseWidget
from tests.classroom import notebook
from tests.toy import make_toy

QUESTION = """
[[question]]
id = "Q5"
kind = "order"
points = 3
title = "Growing an apple"
prompt = "Put the steps in order."
cards = [
    {id = "eat", text = "Eat the apple"},
    {id = "sow", text = "Sow the pip"},
    {id = "water", text = "Water the tree"},
]
hints = ["What comes first?"]
"""
ANSWER = """
["Q5"]
order = ["sow", "water", "eat"]
before = [["sow", "water"], ["water", "eat"]]
explanation = "Nothing is eaten before it has grown."
"""


@pytest.fixture(scope="session")
def orchard_template(tmp_path_factory: pytest.TempPathFactory) -> Path:
    toy = make_toy(tmp_path_factory.mktemp("orchard") / "course", "orchard")
    (toy.root / "notebooks/3_orchard.ipynb").write_text(notebook(['ask("Q1")']))
    toy.add("orchard", QUESTION, ANSWER)
    questions = "notebooks/questions/orchard.toml"
    toy.replace(questions, 'variable = "trees"', 'variable = "trees"\nunit = "trees"')
    toy.replace(questions, '"Look up in spring."', '"Look up in spring.", "Look up in summer."')
    return toy.root


@pytest.fixture
def orchard(orchard_template: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of the test's own in which responses to the course, with its key, are kept.

    The course itself is shared, so that its marker is too.
    """
    monkeypatch.setenv("AUTOGRADER_COURSE", str(orchard_template))
    monkeypatch.setenv("AUTOGRADER_RESPONSES", str(tmp_path / "responses"))
    monkeypatch.chdir(tmp_path)
    return tmp_path / "responses"


@pytest.fixture
def own_orchard(orchard_template: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of the course that the test may change, with the working folder in its notebooks."""
    root = tmp_path / "course"
    shutil.copytree(orchard_template, root)
    monkeypatch.delenv("AUTOGRADER_COURSE", raising=False)
    monkeypatch.delenv("AUTOGRADER_RESPONSES", raising=False)
    monkeypatch.chdir(root / "notebooks")
    return root


@pytest.fixture
def bundle(own_orchard: Path) -> Path:
    """A student bundle: the course without its solutions."""
    shutil.rmtree(own_orchard / "solutions")
    return own_orchard


@pytest.fixture
def sent(monkeypatch: pytest.MonkeyPatch) -> list[dict[str, Any]]:
    """What the widgets reply."""
    replies: list[dict[str, Any]] = []
    monkeypatch.setattr(CourseWidget, "send", lambda self, reply: replies.append(reply))
    return replies
