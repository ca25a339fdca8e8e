"""Override, note, show and regrade, from the command line."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

from autograder.cli import main
from tests.cli.conftest import Classroom


def grades(classroom: Classroom) -> dict[str, dict[str, str]]:
    with (classroom.grades / "grades.csv").open() as file:
        return {row["student"]: row for row in csv.DictReader(file)}


def files(folder: Path) -> dict[str, bytes]:
    return {str(path): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def change_key(classroom: Classroom) -> None:
    """From now on seven trees are right too."""
    path = classroom.course.root / "solutions/answers/orchard.toml"
    path.write_text(
        path.read_text().replace(
            'credit = 0.25\nfeedback = "That is three', 'credit = 0.75\nfeedback = "That is three'
        )
    )


def test_the_class_is_marked_as_its_responses_deserve(classroom: Classroom):
    rows = grades(classroom)
    assert [rows["ada"][id] for id in ("Q1", "Q2", "Q3", "Q4")] == ["2", "2", "2", "4"]
    assert [rows["boole"][id] for id in ("Q1", "Q2", "Q3", "Q4")] == ["2", "0.5", "0", "4"]
    assert rows["'=curie"]["Q4"] == "1"


def test_an_override_is_in_the_csv_at_once_and_names_its_question(classroom: Classroom, capsys):
    assert classroom.run("override", "boole", "Q3", "1.5", "--reason", "drew it") == 0
    assert "1.5 points for Q3, 8 together" in capsys.readouterr().out
    assert grades(classroom)["boole"]["Q3"] == "1.5"
    assert grades(classroom)["boole"]["marked_by_hand"] == "Q3"
    assert classroom.run("override", "boole", "Q3", "none", "--reason", "a mix-up") == 0
    assert grades(classroom)["boole"]["total"] == "6.5"


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("nobody", "Q3", "1", "--reason", "x"), "no student 'nobody'"),
        (("ada", "Q9", "1", "--reason", "x"), "no question 'Q9'"),
        (("ada", "Q3", "much", "--reason", "x"), "'much' is not a number of points"),
        (("ada", "Q3", "nan", "--reason", "x"), "'nan' is not a number of points"),
        (("ada", "Q3", "-1", "--reason", "x"), "'-1' is not a number of points"),
        (("ada", "Q3", "1", "--reason", " "), "reason is empty"),
        (("ada", "Q3", "none", "--reason", "x"), "no override for Q3"),
    ],
)
def test_a_wrong_override_is_refused_in_one_sentence(classroom: Classroom, capsys, arguments, said):
    before = files(classroom.grades)
    assert classroom.run("override", *arguments) == 2
    assert said in capsys.readouterr().err
    assert files(classroom.grades) == before


def test_show_tells_marks_overrides_and_notes(classroom: Classroom, capsys):
    classroom.run("override", "boole", "Q3", "1.5", "--reason", "drew it")
    classroom.run("note", "boole", "was ill")
    capsys.readouterr()
    assert classroom.run("show", "boole") == 0
    out = capsys.readouterr().out
    for said in ("8 of 10 points", "rows and trees added", "given by hand", "drew it", "was ill"):
        assert said in " ".join(out.split())


def test_show_speaks_json(classroom: Classroom, capsys):
    assert classroom.run("show", "boole", "--json") == 0
    shown = json.loads(capsys.readouterr().out)
    assert shown["total"] == 6.5
    assert shown["questions"]["Q2"]["alternative"] == "rows and trees added"
    assert shown["questions"]["Q2"]["understood"] == "7"


def test_a_dry_run_shows_every_difference_and_writes_nothing(classroom: Classroom, capsys):
    change_key(classroom)
    before = files(classroom.grades)
    assert classroom.run("regrade", "--dry-run", "--question", "Q2") == 0
    out = capsys.readouterr().out
    assert "boole: 6.5 → 7.5 points" in out
    assert "Q2: 0.5 (partial, rows and trees added) → 1.5 (partial, rows and trees added)" in out
    assert "ada" not in out
    assert "nothing was written" in out
    assert files(classroom.grades) == before


def test_regrading_after_a_key_change_keeps_overrides_and_inputs(classroom: Classroom, capsys):
    classroom.run("override", "=curie", "Q2", "2", "--reason", "counts them all")
    change_key(classroom)
    assert classroom.run("regrade", "--json") == 0
    told = json.loads(capsys.readouterr().out.split("together.\n")[1])
    assert told["run"]["seed"] == 5
    assert [(c["student"], c["overridden"]) for c in told["changed"]] == [
        ("=curie", True),
        ("boole", False),
    ]
    assert grades(classroom)["'=curie"]["Q2"] == "2"
    assert grades(classroom)["boole"]["Q2"] == "1.5"


def test_grading_again_without_a_change_runs_nothing(classroom: Classroom, monkeypatch):
    ran = []
    monkeypatch.setattr("autograder.grading.submission.grade_contents", lambda *a: ran.append(a))
    assert classroom.run("grade", str(classroom.work)) == 0
    assert ran == []


def test_regrading_names_work_that_has_gone_and_keeps_its_marks(classroom: Classroom, capsys):
    from autograder.gradebook import Gradebook

    with Gradebook(classroom.grades / "gradebook.db") as book, book._transaction() as db:
        db.execute("UPDATE submission SET path = '/gone' WHERE student = 'boole'")
    assert classroom.run("regrade", "ada", "boole", "--question", "Q2") == 0
    assert "boole is no longer at /gone" in capsys.readouterr().err
    assert grades(classroom)["boole"]["total"] == "6.5"


def test_output_that_nobody_watches_is_short_and_plain(classroom: Classroom, capsys):
    assert classroom.run("grade", str(classroom.work)) == 0
    captured = capsys.readouterr()
    assert len(captured.out.splitlines()) == 1
    assert "\x1b" not in captured.out + captured.err


def test_looking_before_grading_says_what_to_do(tmp_path: Path, classroom: Classroom, capsys):
    course = str(classroom.course.root)
    assert main(["--course", course, "show", "ada", "--out", str(tmp_path / "none")]) == 1
    assert "run `autograder grade` first" in capsys.readouterr().err
