"""A class whose students have numbers of their own, from the notebook to the gradebook."""

from __future__ import annotations

import json
from pathlib import Path
from typing import get_args

import numpy as np
import pytest

from autograder.cli import main
from autograder.course import Course
from autograder.course.places import FILE as FILE_OF_PLACES
from autograder.course.places import make_places
from autograder.exchange.identity import FILE
from autograder.gradebook import Record
from autograder.gradebook.book import Gradebook
from autograder.grading.graded_submission import Graded
from autograder.grading.submission import grade_contents, grade_submission
from autograder.intake.name_in_code import said_in_code
from autograder.intake.submissions import Contents, Notebook, Submission
from autograder.marking import Mark
from autograder.marking.marker import Marker
from autograder.reports.class_html import class_html
from autograder.reports.common_mistakes import MistakesMade
from autograder.reports.variant_difficulty import Difficulty, VariantSums
from autograder.sandbox.launcher import Isolation, Sandbox
from tests.toy import make_toy

QUESTION = """
[story.market]
boxes = [3, 5, 7, 11, 13, 17]
eggs = [4, 6, 9, 10, 12]

[[question]]
id = "Q7"
kind = "number"
title = "Eggs"
points = 4
story = "market"
variable = "bought"
integer = true
prompt = "{boxes} boxes of {eggs} eggs: how many?"
hints = ["Multiply."]
"""
ANSWER = """
["Q7"]
code = "boxes * eggs"
alternative = [
    {name = "right", credit = 1, value = "boxes*eggs"},
    {name = "added", credit = 0.25, value = "boxes + eggs", feedback = "{boxes} + {eggs} adds."},
]
"""
NAMES = ["Ada Lovelace", "George Boole", "Johannes Kepler", "Emmy Noether", "Rosa Parks"]


@pytest.fixture(scope="module")
def market(tmp_path_factory) -> Course:
    course = make_toy(tmp_path_factory.mktemp("market") / "course")
    course.add("kitchen", QUESTION, ANSWER)
    return course.set('variants = "student"\nothers_numbers = "nothing"').load()


def hand_in(folder: Path, name: str, says: str, bought: int | str) -> None:
    """A folder as ``submit()`` packs it: a notebook, and who it says it is from."""
    code = {"cell_type": "code", "id": "c1", "metadata": {}, "outputs": [], "execution_count": None}
    cell = {**code, "source": f"bought = {bought}"}
    notebook = {"cells": [cell], "metadata": {}, "nbformat": 4, "nbformat_minor": 5}
    (folder / name / "responses").mkdir(parents=True)
    (folder / name / "1_kitchen.ipynb").write_text(json.dumps(notebook))
    if says:
        entry = {"responses": {FILE: {"response": says}}}
        (folder / name / "responses" / f"{FILE}.json").write_text(json.dumps(entry))


def test_what_a_notebook_computes_from_its_numbers_is_right_for_its_student(
    market: Course, tmp_path: Path, capsys
):
    """The grader's process finds the numbers of the student whose notebook it runs."""
    source = (
        "0\nfrom autograder import numbers\nboxes, eggs = numbers('market')\nbought = boxes * eggs"
    )
    for name in NAMES[:3]:
        hand_in(tmp_path / "class", name.split()[1], name, source)
    hand_in(tmp_path / "class", "nobody", "", source)
    out = tmp_path / "grades"
    command = ["--course", str(market.root), "grade", str(tmp_path / "class"), "--out", str(out)]
    assert main([*command, "--question", "Q7"]) == 0
    with Gradebook(out / "gradebook.db") as book:
        records = list(book.records())
    assert [record.graded.marks[0].status for record in records] == ["right"] * 4
    assert len({record.graded.marks[0].understood for record in records}) > 1


@pytest.mark.parametrize("call", ['me("Ada Lovelace")', "me( 'Ada Lovelace' )  # that is me"])
def test_a_notebook_without_its_responses_is_marked_by_the_name_in_it(market: Course, call: str):
    """What it computes from its numbers is right; the sheet's are somebody else's."""
    assert market.for_student(NAMES[0]).numbers("Q7") != market.numbers("Q7")
    source = f"import math\n\n{call}\nboxes, eggs = numbers('market')\nbought = boxes * eggs"
    start = "from autograder import me, numbers"
    contents = Contents({"kitchen": Notebook(cells=[start, source], receipts={})}, sidecars={})
    submission = Submission("ada", Path("ada"))
    with Sandbox(market, "none") as sandbox:
        graded = grade_submission(submission, contents, Marker(market, 1), sandbox, ["Q7"])
    assert graded.marks[0].status == "right", graded.marks[0]
    assert graded.numbers_of == NAMES[0]


@pytest.mark.parametrize(
    ("cells", "name"),
    [
        (['me("Ada")'], "Ada"),
        (["import x\n\nme('Ada')  # that is me", "me(17)"], "17"),
        (["me()", "me(name)", '# me("Ada")', 'some("Ada")', 'print(me("Ada"))'], ""),
        (['me("A\tda")'], "A da"),
    ],
)
def test_a_name_is_read_in_code_without_running_it(cells: list[str], name: str):
    assert said_in_code(cells) == name


@pytest.mark.parametrize("tier", get_args(Isolation))
def test_a_notebook_finds_the_numbers_that_were_dealt(tmp_path: Path, tier: Isolation):
    """Not those that a name alone decides: the process sees everybody's place, as students do."""
    dealt = make_toy(tmp_path / "course").add("kitchen", QUESTION, ANSWER)
    dealt.set('variants = "student"')
    by_name = dealt.load()
    (dealt.root / FILE_OF_PLACES).write_text(
        make_places({name: n for n, name in enumerate(NAMES)}).text()
    )
    course = dealt.load()
    student = next(
        name
        for name in NAMES
        if course.for_student(name).numbers("Q7") != by_name.for_student(name).numbers("Q7")
    )
    source = (
        "from autograder import numbers\nboxes, eggs = numbers('market')\nbought = boxes * eggs"
    )
    contents = Contents(
        {"kitchen": Notebook(cells=[source], receipts={})},
        sidecars={FILE: {FILE: {"response": student}}},
    )
    with Sandbox(course, tier) as sandbox:
        (mark,) = grade_contents(contents, Marker(course, 1), sandbox, ["Q7"])
    assert mark.status == "right", mark


def test_everybody_is_marked_by_their_own_numbers(market: Course, tmp_path: Path, capsys):
    numbers = {name: market.for_student(name).numbers("Q7") for name in NAMES}
    right = {name: n["boxes"] * n["eggs"] for name, n in numbers.items()}
    ada, _, kepler, noether, _ = NAMES
    assert len(set(right.values())) > 1
    neighbor = next(name for name in NAMES if right[name] != right[kepler])
    work = tmp_path / "class"
    hand_in(work, "ada", "  ada LOVELACE", right[ada])
    hand_in(work, "boole", ada, right[ada])  # the folder of somebody else
    hand_in(work, "kepler", "kepler", market.for_student("kepler").numbers("Q7")["boxes"] * 1000)
    hand_in(work, "noether", noether, sum(numbers[noether].values()))
    hand_in(work, "parks", "", 12)  # the sheet's numbers
    others = {n["boxes"] * n["eggs"] for n in numbers.values()} - {right[neighbor]}
    hand_in(work, "copies", neighbor, max(others))
    people = "".join(f"{name},{name.split()[-1].lower()}\n" for name in NAMES)
    (tmp_path / "list.csv").write_text("Name,Login\n" + people.replace("lovelace", "ada"))
    out = tmp_path / "grades"
    command = ["--course", str(market.root), "grade", str(work), "--out", str(out), "--question"]
    assert main([*command, "Q7", "--class-list", str(tmp_path / "list.csv")]) == 0
    with Gradebook(out / "gradebook.db") as book:
        records = {record.student: record for record in book.records()}
    marks = {name: record.graded.marks[0] for name, record in records.items()}
    notes = {name: " ".join(record.graded.notes) for name, record in records.items()}
    assert marks["ada"].status == "right"
    assert "numbers" not in notes["ada"]
    assert (marks["boole"].status, marks["boole"].credit) == ("wrong", 0)
    assert f"numbers of '{ada}', not with their own" in notes["boole"]
    assert "numbers" not in notes["kepler"]  # the login is a name too
    assert (marks["noether"].alternative, marks["noether"].credit) == ("added", 0.25)
    boxes, eggs = numbers[noether].values()
    assert marks["noether"].feedback == f"{boxes} + {eggs} adds."
    assert marks["parks"].status == "right"
    assert "numbers of the sheet" in notes["parks"]
    assert marks["copies"].alternative == "right for other numbers"


def test_show_key_prints_the_numbers_and_answers_of_one_student(market, tmp_path, capsys):
    ada = NAMES[0]
    numbers = market.for_student(ada).numbers("Q7")
    right = numbers["boxes"] * numbers["eggs"]
    hand_in(tmp_path / "class", "ada", ada, right + 1)
    out = ["--out", str(tmp_path / "grades")]
    course = ["--course", str(market.root)]
    assert main([*course, "grade", str(tmp_path / "class"), *out, "--question", "Q7"]) == 0
    capsys.readouterr()
    assert main([*course, "show", "ada", *out, "--key"]) == 0
    said = capsys.readouterr().out
    assert f"marked by the numbers of {ada}" in said
    assert f"Q7 Eggs (boxes = {numbers['boxes']}, eggs = {numbers['eggs']})\n    {right}\n" in said
    assert "true: Water boils at 100 °C." in said


def answered(student: str, id: str, credit: float) -> Record:
    mark = Mark(id, "right" if credit == 1 else "wrong", credit, 4.0, "")
    graded = Graded(
        Submission(student, Path(student)), "graded", student, (mark,), numbers_of=student
    )
    return Record(graded, 1, 1)


def test_a_variant_that_is_harder_is_found_and_equal_ones_are_not(market):
    names = [f"student {n}" for n in range(240)]
    numbers = {name: market.for_student(name).numbers("Q7") for name in names}
    rng = np.random.default_rng(0)
    luck = {name: float(rng.random() < 0.7) for name in names}

    def difficulty(unlucky: int) -> Difficulty:
        found = VariantSums(market)
        for name in names:
            hard = numbers[name]["boxes"] == unlucky
            found.add(answered(name, "Q7", 0.0 if hard else luck[name]))
        return found.difficulties()[0]

    equal, harder = difficulty(0), difficulty(11)
    assert (equal.students, equal.variants) == (240, 30)
    assert equal.chance > 0.05
    assert harder.chance < 0.01
    assert harder.hardest.startswith("boxes = 11, eggs = ")
    # One variant of the five hard ones against all others, of which one in seven is hard.
    assert 0.3 < harder.low < harder.less < harder.high < 0.8
    page = class_html(market, [answered(name, "Q7", luck[name]) for name in names], None)
    assert "Were all variants equally hard?" in page


def test_a_mistake_has_one_name_in_all_variants(tmp_path):
    course = make_toy(tmp_path / "course")
    course.replace(
        "notebooks/questions/kitchen.toml",
        'hints = ["Put an ice cube into a glass."]',
        'hints = ["Put an ice cube into a glass."]\ndraws = [[1, 2], [2, 3], [3, 2]]',
    )
    loaded = course.set('variants = "student"').load()
    made = MistakesMade(loaded)
    for name in ("ada", "boole", "kepler", "noether", "hopper", "parks"):
        own = loaded.for_student(name)
        ice = own.question("Q1.1").statements.index("Ice sinks in water.")
        said = [statement.truth for statement in own.key["Q1.1"].statements]
        said[ice] = True
        mark = Marker(own, 1).mark("Q1.1", said)
        graded = Graded(Submission(name, Path(name)), "graded", name, (mark,), numbers_of=name)
        made.add(Record(graded, 1, 1))
    (mistake,) = made.mistakes()
    assert mistake.name == "statement 2 of the bank called true"
    assert len(mistake.students) == 6
