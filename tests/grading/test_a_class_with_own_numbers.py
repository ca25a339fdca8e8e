"""A class that answers by a script, right and with each known mistake, in the shipped course."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from autograder.cli import main
from autograder.course import Course, load_course
from autograder.exchange.identity import FILE
from autograder.gradebook.book import Gradebook
from autograder.kinds.registry import kind_of
from autograder.marking.draw import draw
from autograder.marking.marker import OTHER_NUMBERS

ROOT = Path(__file__).parents[2]
CHAPTER = "ransac"


@pytest.fixture(scope="module")
def personal(tmp_path_factory: pytest.TempPathFactory) -> Course:
    """The shipped course with numbers of everybody's own."""
    root = tmp_path_factory.mktemp("personal")
    for name in ("data", "notebooks", "solutions"):
        (root / name).symlink_to(ROOT / name)
    (root / "pyproject.toml").write_text('[tool.autograder]\nvariants = "student"\n')
    return load_course(root)


def hand_in(folder: Path, name: str, values: dict[str, Any], choices: dict[str, Any]) -> None:
    """What ``submit()`` packs: values assigned in the notebook, and choices kept beside it."""
    lines = [f"{variable} = {value!r}" for variable, value in values.items()]
    cell = {"cell_type": "code", "id": "c1", "metadata": {}, "outputs": [], "execution_count": None}
    cells = [{**cell, "source": "\n".join(lines)}]
    notebook = {"cells": cells, "metadata": {}, "nbformat": 4, "nbformat_minor": 5}
    (folder / name / "responses").mkdir(parents=True)
    (folder / name / f"3_{CHAPTER}.ipynb").write_text(json.dumps(notebook))
    kept = {id: {"response": response} for id, response in choices.items()}
    for file, entries in ((CHAPTER, kept), (FILE, {FILE: {"response": name}})):
        text = json.dumps({"responses": entries})
        (folder / name / "responses" / f"{file}.json").write_text(text)


def grade(course: Course, folder: Path, out: Path, ids: list[str]) -> dict[str, dict[str, Any]]:
    asked = [word for id in ids for word in ("--question", id)]
    command = ["--course", str(course.root), "grade", str(folder), "--out", str(out)]
    assert main([*command, *asked]) == 0
    with Gradebook(out / "gradebook.db") as book:
        return {
            record.student: {mark.question: mark for mark in record.graded.marks}
            for record in book.records()
        }


@pytest.mark.parametrize("students", [12, pytest.param(300, marks=pytest.mark.long)])
def test_right_work_earns_all_and_each_mistake_its_name(students, personal, tmp_path, capsys):
    """Each student makes another mistake in each question; what is expected is told by the key."""
    ids = [
        id for id, q in personal.questions.items() if id.startswith("Q3.2") and q.kind == "number"
    ]
    expected: dict[str, dict[str, Any]] = {}
    stories = set()
    for n in range(students):
        name = f"student {n:03}"
        own = personal.for_student(name)
        stories.add(tuple(own.story("cloud").values()))
        values, expected[name] = {}, {}
        for id in ids:
            question, answer = own.question(id), own.key[id]
            chosen = answer.alternatives[n % len(answer.alternatives)]
            drawn = draw(question, answer, 1, own.root)
            values[question.name] = kind_of(question).response_like(question, chosen, drawn)[
                "value"
            ]
            expected[name][id] = chosen.name, chosen.credit
        truths = [statement.truth for statement in own.key["Q3.1"].statements]
        if n % 2:
            truths[n % len(truths)] ^= True
        expected[name]["Q3.1"] = None, 1 - 0.25 * (n % 2)
        hand_in(tmp_path / "class", name, values, {"Q3.1": truths})
    assert len(stories) > students / 3 or len(stories) == 24
    marked = grade(personal, tmp_path / "class", tmp_path / "grades", [*ids, "Q3.1"])
    for name, wanted in expected.items():
        for id, (mistake, credit) in wanted.items():
            mark = marked[name][id]
            assert mark.credit == pytest.approx(credit), (name, id)
            assert mistake in (None, mark.alternative), (name, id)


def test_the_answers_of_a_neighbor_are_noticed(personal, tmp_path, capsys):
    first, second = "student 001", "student 002"
    ids = ["Q3.2.1", "Q3.2.5"]
    right = {}
    for name in (first, second):
        own = personal.for_student(name)
        right[name] = {own.question(id).name: int(own.key[id].alternatives[0].value) for id in ids}
    assert all(right[first][name] != right[second][name] for name in right[first])
    hand_in(tmp_path / "class", first, right[second], {})
    hand_in(tmp_path / "class", second, right[first], {})
    marked = grade(personal, tmp_path / "class", tmp_path / "grades", ids)
    # The right number of one may be what a mistake gives with the numbers of another.
    for marks in marked.values():
        assert OTHER_NUMBERS in {mark.alternative for mark in marks.values()}
        assert all(mark.credit < 1 for mark in marks.values())
