"""What students are told of their own exceptions, and what never is."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from autograder.cli import main
from autograder.gradebook import Gradebook, Record
from autograder.sandbox.inside.exceptions import after_import, tell
from tests.classroom import hand_in, make_course
from tests.toy import Toy


@pytest.fixture(scope="module")
def records(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Record]:
    root = tmp_path_factory.mktemp("orchard")
    make_course(root / "course")
    work = root / "work"
    hand_in(work, "raises", Q4='def heaviest(weights):\n    raise ValueError(f"got {weights}")')
    hand_in(
        work,
        "hides",
        Q4="seen = []\ndef heaviest(weights):\n    seen.append(list(weights))\n"
        "    if len(weights) > 3:\n        raise ValueError(f'got {weights}')\n"
        "    raise KeyError(str(seen))",
    )
    hand_in(
        work,
        "keeps",
        Q4="from pathlib import Path\nkept = Path('kept')\ndef heaviest(weights):\n"
        "    text = kept.read_text() if kept.exists() else ''\n"
        "    kept.write_text(text + repr(weights))\n    raise ValueError(text)",
    )
    hand_in(work, "broken", Q4="import math\n1 / 0\ndef heaviest(weights):\n    return 1")
    hand_in(
        work,
        "imports",
        Q2="import math, nowhere.at_all as n, json\ntrees = len(json.dumps(12345678901))+1",
    )
    hand_in(
        work, "needs", Q4="from nowhere import maximum\ndef heaviest(w):\n    return maximum(w)"
    )
    hand_in(work, "right")
    arguments = ["grade", str(work), "--out", str(root / "grades"), "--seed", "5"]
    assert main(["--course", str(root / "course"), *arguments]) == 0
    with Gradebook(root / "grades/gradebook.db") as book:
        found = {record.student: record for record in book.records()}
    for record in found.values():
        path = root / "grades/feedback" / f"{record.student}.html"
        object.__setattr__(record, "page", path.read_text())
    return found


def page(record: Record) -> str:
    return str(vars(record)["page"])


def test_a_function_s_exception_is_told_with_the_public_input_and_its_line(records):
    told = records["raises"].marks["Q4"].told
    assert told.startswith("ValueError: got [120.0, 180.0, 150.0]")
    assert "line 2 of the cell: raise ValueError" in told
    assert "It raised" in page(records["raises"])


def test_a_message_never_holds_a_hidden_input(records):
    # Three apples are public; every hidden basket has seven, and starts with 251.5 or 49.
    for student in ("hides", "keeps"):
        mark = records[student].marks["Q4"]
        assert mark.told
        text = json.dumps(mark.to_dict())
        assert "251.5" not in text
        assert "49.0" not in text
    assert records["hides"].marks["Q4"].told.startswith("KeyError: '[[120.0, 180.0, 150.0]]'")


def test_the_cell_that_failed_names_its_exception_and_line(records):
    mark = records["broken"].marks["Q4"]
    assert mark.status == "error"
    assert mark.told == "ZeroDivisionError: division by zero, at line 2 of the cell: 1 / 0"


def test_the_rest_of_an_import_cell_runs_and_the_missing_module_is_named(records):
    assert records["imports"].marks["Q2"].status == "right"
    (note,) = records["imports"].graded.notes
    assert "nowhere is not installed where this is marked" in note
    assert "line 1" in note


def test_what_needs_a_missing_module_says_so_itself(records):
    assert "name 'maximum' is not defined" in records["needs"].marks["Q4"].told
    assert "nowhere is not installed" in page(records["needs"])


def test_the_code_stands_folded_under_the_response_and_is_only_text(records):
    assert "<details><summary>Your code</summary>" in page(records["right"])
    assert "return max(weights)" in page(records["right"])
    assert records["right"].marks["Q2"].code == "trees = 12"
    assert records["right"].marks["Q4"].told == ""


@pytest.mark.parametrize(
    ("cell", "left"),
    [
        ("import nowhere\nx = 1", "\nx = 1"),
        ("import json\nimport nowhere as n, math\nx = 1", "\nimport math\nx = 1"),
        ("from nowhere import (\n  a,\n  b,\n)\nx = 1", "\n\n\n\nx = 1"),
        ("if True:\n    import nowhere\nx = 1", None),
        ("x = 1\ny = __import__('nowhere')", None),
        ("import nowhere", ""),
    ],
)
def test_what_comes_after_a_missing_import_keeps_its_lines(cell: str, left: str | None):
    with pytest.raises(ModuleNotFoundError) as caught:
        exec(compile(cell, "<ipython-input-1-abc>", "exec"), {})
    rest = after_import(cell, caught.value)
    assert (rest if rest is None else rest.rstrip("\n")) == (
        left if left is None else left.rstrip("\n")
    )


def test_an_exception_that_cannot_be_printed_is_still_told():
    class Odd(Exception):
        def __str__(self) -> str:
            raise RuntimeError

    assert tell(Odd()) == {"kind": "Odd", "message": ""}


@pytest.mark.parametrize(
    ("value", "words"),
    [
        ('"pandas"', "must be a list"),
        ("[3]", "must be a text in quotes"),
        ('["no such"]', "as they are imported"),
        ('["a/b"]', "as they are imported"),
    ],
)
def test_packages_that_are_no_names_are_refused(tmp_path: Path, value: str, words: str, capsys):
    make_course(tmp_path / "course")
    Toy(tmp_path / "course").set(f"packages = {value}")
    hand_in(tmp_path / "work", "ada")
    assert main(["--course", str(tmp_path / "course"), "grade", str(tmp_path / "work")]) == 1
    assert words in capsys.readouterr().err


def test_a_package_that_the_course_allows_and_nobody_installed_stops_the_run(tmp_path, capsys):
    make_course(tmp_path / "course")
    Toy(tmp_path / "course").set('packages = ["nowhere"]')
    hand_in(tmp_path / "work", "ada")
    arguments = ["grade", str(tmp_path / "work"), "--out", str(tmp_path / "grades")]
    assert main(["--course", str(tmp_path / "course"), *arguments]) == 1
    assert "nowhere" in capsys.readouterr().err


def test_an_exception_is_told_wherever_the_public_inputs_stand(tmp_path: Path):
    make_course(tmp_path / "course")
    key = tmp_path / "course/orchard_reference.py"
    text = key.read_text()
    listed = '        {"name": "three apples", "args": [[120.0, 180.0, 150.0]], "public": True},\n'
    assert listed in text
    last = listed.replace("three apples", "two apples").replace(", 150.0", "")
    key.write_text(text.replace(listed, "").replace("    ]\n", f"{listed}{last}    ]\n"))
    raises = 'def heaviest(weights):\n    raise ValueError(f"got {weights}")'
    hand_in(tmp_path / "work", "always", Q4=raises)
    hand_in(tmp_path / "work", "typo", Q4="def heaviest(weights):\n    return max(weight)")
    of_two = (
        'def heaviest(w):\n    if len(w) == 2:\n        raise KeyError("two")\n    return max(w)'
    )
    hand_in(tmp_path / "work", "of_two", Q4=of_two)
    arguments = ["grade", str(tmp_path / "work"), "--out", str(tmp_path / "grades")]
    assert main(["--course", str(tmp_path / "course"), *arguments]) == 0
    with Gradebook(tmp_path / "grades/gradebook.db") as book:
        told = {record.student: record.marks["Q4"].told for record in book.records()}
    assert told["always"].startswith("ValueError: got [120.0, 180.0, 150.0]")
    assert told["typo"].startswith("NameError: name 'weight' is not defined")
    assert told["of_two"].startswith("KeyError: 'two'")
    assert "251.5" not in json.dumps(told)
