"""People by name, spreadsheets, and the way back to students, from the command line."""

from __future__ import annotations

import csv
import json
import zipfile
from pathlib import Path

import pytest

from tests.cli.conftest import Classroom

CLASS = """
[[student]]
name = "Ada Lovelace"
login = "ada"
email = "ada.lovelace@example.org"
id = "4711"
section = "Tuesday"

[[student]]
name = "George Boole"
login = "boole"
email = "george@example.org"

[[student]]
name = "Grace Hopper"
login = "hopper"
"""


@pytest.fixture
def listed(classroom: Classroom) -> Classroom:
    (classroom.grades / "class.toml").write_text(CLASS)
    return classroom


def read_rows(path: Path) -> list[dict[str, str]]:
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


@pytest.mark.parametrize(
    "said", ["Ada Lovelace", "lovelace, ada", "ada", "ADA", "4711", "Ada.Lovelace@example.org"]
)
def test_a_student_is_found_by_whatever_an_instructor_knows(listed: Classroom, capsys, said: str):
    assert listed.run("show", said, "--json") == 0
    shown = json.loads(capsys.readouterr().out)
    assert (shown["student"], shown["name"]) == ("ada", "Ada Lovelace")


@pytest.mark.parametrize("said", ["Lovelac", "Lövelac", "Loevelac"])  # as on another keyboard
def test_a_name_that_fits_nobody_says_who_is_near(listed: Classroom, capsys, said: str):
    assert listed.run("show", said) == 2
    assert "Ada Lovelace (ada)" in capsys.readouterr().err


def test_an_override_and_a_note_go_to_a_person_and_keep_their_author(listed: Classroom, capsys):
    by = ("--author", "tutor one")
    assert listed.run("override", "George Boole", "Q3", "1", "--reason", "oral", *by) == 0
    assert "George Boole has 1 points for Q3" in capsys.readouterr().out
    assert listed.run("note", "george@example.org", "was ill", *by) == 0
    listed.run("show", "boole")
    out = " ".join(capsys.readouterr().out.split())
    assert "by tutor one: Q3 1 points (oral)" in out
    assert "by tutor one: was ill" in out


def test_a_spreadsheet_goes_out_and_comes_back(listed: Classroom, capsys, tmp_path: Path):
    sheet = tmp_path / "overrides.csv"
    assert listed.run("override", "--write", str(sheet), "--all") == 0
    rows = read_rows(sheet)
    assert len(rows) == 3 * 4
    text = sheet.read_text()
    row = next(line for line in text.splitlines() if line.startswith("boole,George Boole,Q3"))
    cells = row.split(",")
    cells[4], cells[6] = "1.5", "drew it"
    # As Excel writes it in Germany: a byte order mark, semicolons, a decimal comma.
    changed = text.replace(row, ",".join(cells)).replace(",", ";").replace("1.5", "1,5")
    sheet.write_bytes(b"\xef\xbb\xbf" + changed.encode())
    assert listed.run("override", "--read", str(sheet), "--dry-run") == 0
    assert "boole Q3: 1.5 points (drew it)" in capsys.readouterr().out
    assert listed.run("override", "--read", str(sheet)) == 0
    rows = read_rows(listed.grades / "grades.csv")
    assert next(r for r in rows if r["student"] == "boole")["Q3"] == "1.5"
    capsys.readouterr()
    assert listed.run("override", "--read", str(sheet)) == 0
    assert capsys.readouterr().out.startswith("0 differ")


@pytest.mark.parametrize(
    ("row", "said"),
    [
        ("eve,Q1,1", "no student 'eve'"),
        ("ada,Q9,1", "no question 'Q9'"),
        ("ada,Q1,much", "'much' is not a number of points"),
        ("ada,Q1,1\nada,Q1,2", "two rows for Q1"),
    ],
)
def test_a_row_that_cannot_be_understood_changes_nothing(
    listed: Classroom, capsys, tmp_path: Path, row: str, said: str
):
    sheet = tmp_path / "overrides.csv"
    sheet.write_text(f"student,question,points\nboole,Q1,0\n{row}\n")
    assert listed.run("override", "--read", str(sheet)) == 2
    error = capsys.readouterr().err
    assert said in error
    assert "line " in error
    listed.run("override", "--write", str(sheet))
    assert read_rows(sheet) == []


def test_feedback_for_folders_leaves_out_what_is_nobody_s_and_says_so(listed: Classroom, capsys):
    assert listed.run("feedback", "--for", "folder") == 1
    captured = capsys.readouterr()
    assert "holds the feedback of 2 students" in captured.out
    assert "=curie goes to nobody" in captured.err
    folder = listed.grades / "feedback_for_folder"
    assert sorted(path.name for path in folder.iterdir()) == [
        "Ada Lovelace (ada)",
        "George Boole (boole)",
    ]
    assert "Ada Lovelace" in (folder / "Ada Lovelace (ada)/feedback.html").read_text()


def test_a_dry_run_of_mail_says_who_would_get_it_and_writes_nothing(listed: Classroom, capsys):
    before = sorted(listed.grades.rglob("*"))
    mail = ["--for", "email", "--smtp", "mail.example.org", "--from", "t@example.org", "--dry-run"]
    assert listed.run("feedback", *mail, "--student", "Ada Lovelace") == 0
    out = capsys.readouterr().out
    assert "to Ada Lovelace <ada.lovelace@example.org>: Feedback: Autograder" in out
    assert "none was" in out
    assert sorted(listed.grades.rglob("*")) == before


def test_work_that_moodle_never_named_is_left_out_of_its_zip(classroom: Classroom, capsys):
    assert classroom.run("feedback", "--for", "moodle") == 1
    error = capsys.readouterr().err
    assert "The feedback of 3 students (=curie, ada, boole) goes to nobody" in error
    assert error.count("no participant number") == 1
    with zipfile.ZipFile(classroom.grades / "feedback_for_moodle.zip") as archive:
        assert archive.namelist() == []


@pytest.mark.parametrize("command", [("export", "--format", "csv"), ("feedback", "--for", "email")])
def test_points_that_changed_since_are_not_handed_out(listed: Classroom, capsys, command):
    path = listed.course.root / "notebooks/questions/orchard.toml"
    path.write_text(path.read_text().replace("points = 4", "points = 6"))
    assert listed.run(*command) == 1
    assert "The points of Q4 have changed" in capsys.readouterr().err
    assert listed.run("regrade") == 0
    assert listed.run("export", "--format", "csv") == 0


def test_a_list_given_for_looking_is_not_kept(classroom: Classroom, capsys, tmp_path: Path):
    (tmp_path / "list.csv").write_text("Name,Login\nAda Lovelace,ada\n")
    given = ("--class-list", str(tmp_path / "list.csv"))
    assert classroom.run("show", "ada", "--json", *given) == 0
    assert json.loads(capsys.readouterr().out)["name"] == "Ada Lovelace"
    classroom.run("show", "ada", "--json")
    assert json.loads(capsys.readouterr().out)["name"] == "ada"
    assert classroom.run("note", "ada", "was ill", *given) == 0
    capsys.readouterr()
    classroom.run("show", "ada", "--json")
    assert json.loads(capsys.readouterr().out)["name"] == "Ada Lovelace"
