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
from autograder.marking.draw import draw
from autograder.marking.marker import OTHER_NUMBERS
from autograder.questions.registry import kind_of

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def personal(tmp_path_factory: pytest.TempPathFactory) -> Course:
    """The shipped course with numbers of everybody's own."""
    root = tmp_path_factory.mktemp("personal")
    for name in ("data", "notebooks", "solutions"):
        (root / name).symlink_to(ROOT / name)
    (root / "pyproject.toml").write_text('[tool.autograder]\nvariants = "student"\n')
    return load_course(root)


class Typed(str):
    """What stands in a cell as it is."""

    __repr__ = str.__str__


def hand_in(
    course: Course, folder: Path, name: str, values: dict[str, Any], choices: dict[str, Any]
) -> None:
    """What ``submit()`` packs: values assigned in a notebook, and choices kept beside it."""
    (folder / name / "responses").mkdir(parents=True)
    for number, chapter in enumerate(course.chapters, 1):
        names = {question.name for question in chapter.questions}
        lines = ["import sympy as sp", "w = sp.Symbol('w')"]
        lines += [f"{key} = {value!r}" for key, value in values.items() if key in names]
        cell = {"cell_type": "code", "id": "c1", "metadata": {}, "outputs": []}
        cells = [{**cell, "execution_count": None, "source": "\n".join(lines)}]
        notebook = {"cells": cells, "metadata": {}, "nbformat": 4, "nbformat_minor": 5}
        path = folder / name / f"{number}_{chapter.name}.ipynb"
        path.write_text(json.dumps(notebook))
        ids = [question.id for question in chapter.questions if question.id in choices]
        kept = {id: {"response": choices[id]} for id in ids}
        _keep(folder / name, chapter.name, kept)
    _keep(folder / name, FILE, {FILE: {"response": name}})


def _keep(folder: Path, file: str, entries: dict[str, Any]) -> None:
    (folder / "responses" / f"{file}.json").write_text(json.dumps({"responses": entries}))


def in_wrong_order(answer: Any, mistake: Any) -> list[str]:
    """The right order, with the card that the mistake has too early moved before the other."""
    cards = [card for card in answer.order if card != mistake.first]
    cards.insert(cards.index(mistake.second), mistake.first)
    return cards


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
    by_kind: dict[str, list[str]] = {}
    for id in personal.varied:
        question = personal.question(id)
        # Where only the example is another, the key is the same for all.
        if not (kind_of(question).varies_in_words or id.startswith("Q2.2")):
            by_kind.setdefault(question.kind, []).append(id)
    assert by_kind == {
        "true_false": ["Q1.1", "Q2.1", "Q3.1"],
        "order": ["Q1.2"],
        "expression": ["Q3.2.3a"],
        "number": [f"Q3.2.{part}" for part in ("1", "2", "3b", "4", "5")],
    }
    expected: dict[str, dict[str, tuple[str | None, float | None]]] = {}
    stories = set()
    for n in range(students):
        name = f"student {n:03}"
        own = personal.for_student(name)
        stories.add(tuple(own.story("cloud").values()))
        values, choices, wanted = {}, {}, {}
        for id in by_kind["number"]:
            question, answer = own.question(id), own.key[id]
            chosen = answer.alternatives[n % len(answer.alternatives)]
            drawn = draw(question, answer, 1, own.root)
            like = kind_of(question).response_like(question, chosen, drawn)
            values[question.name] = like["value"]
            wanted[id] = chosen.name, chosen.credit
        for id in by_kind["expression"]:
            answer = own.key[id]
            chosen = answer.alternatives[n % len(answer.alternatives)]
            values[own.question(id).name] = Typed(chosen.expression)
            wanted[id] = chosen.name, chosen.credit
        for id in by_kind["true_false"]:
            truths = [statement.truth for statement in own.key[id].statements]
            if n % 2:
                truths[n % len(truths)] ^= True
            choices[id] = truths
            wanted[id] = None, 1 - n % 2 / len(truths)
        for id in by_kind["order"]:
            answer = own.key[id]
            ways = [None, *answer.alternatives]
            chosen = ways[n % len(ways)]
            choices[id] = in_wrong_order(answer, chosen) if chosen else list(answer.order)
            wanted[id] = (chosen.name, None) if chosen else (None, 1)
        expected[name] = wanted
        hand_in(personal, tmp_path / "class", name, values, choices)
    assert len(stories) > students / 3 or len(stories) == 24
    marked = grade(personal, tmp_path / "class", tmp_path / "grades", list(personal.varied))
    assert set(marked) == set(expected)
    for name, wanted in expected.items():
        for id, (mistake, credit) in wanted.items():
            mark = marked[name][id]
            if credit is None:
                assert mark.credit < 1, (name, id)
            else:
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
    hand_in(personal, tmp_path / "class", first, right[second], {})
    hand_in(personal, tmp_path / "class", second, right[first], {})
    marked = grade(personal, tmp_path / "class", tmp_path / "grades", ids)
    # The right number of one may be what a mistake gives with the numbers of another.
    for marks in marked.values():
        assert OTHER_NUMBERS in {mark.alternative for mark in marks.values()}
        assert all(mark.credit < 1 for mark in marks.values())
