"""Export and release, from the command line."""

from __future__ import annotations

import csv
import json
import os
import time
from pathlib import Path

import pytest

from tests.cli.conftest import Classroom

CLASS = """
[assignment]
title = "Orchard"

[late]
due = 2026-10-01T12:00:00Z
percent_a_day = 10
most_percent = 50

[[student]]
name = "Ada Lovelace"
login = "ada"
handed_in = 2026-10-02T11:00:00Z

[[student]]
name = "George Boole"
login = "boole"
extension_days = 20000

[[student]]
name = "Grace Hopper"
login = "hopper"
"""


@pytest.fixture
def listed(classroom: Classroom) -> Classroom:
    (classroom.grades / "class.toml").write_text(CLASS)
    return classroom


@pytest.mark.parametrize("format", ["csv", "canvas", "moodle"])
def test_a_csv_is_written_beside_the_gradebook(listed: Classroom, capsys, format: str):
    assert listed.run("export", "--format", format) == 0
    captured = capsys.readouterr()
    assert f"{format}.csv is written" in captured.out
    assert "1 submissions belong to nobody" in captured.err
    assert "Grace Hopper" in captured.err
    assert (listed.grades / f"{format}.csv").stat().st_size > 100


def test_gradescope_gets_the_archive_and_the_results(listed: Classroom, capsys):
    assert listed.run("export", "--format", "gradescope") == 0
    folder = listed.grades / "gradescope"
    assert (folder / "autograder.zip").is_file()
    assert json.loads((folder / "results/ada/results.json").read_text())["score"] == 10
    assert len(list((folder / "results").iterdir())) == 3


def test_canvas_without_a_class_list_says_what_to_write(classroom: Classroom, capsys):
    assert classroom.run("export", "--format", "canvas") == 2
    assert "[[student]]" in capsys.readouterr().err


def test_an_unknown_format_is_wrong_usage(classroom: Classroom):
    with pytest.raises(SystemExit) as stopped:
        classroom.run("export", "--format", "excel")
    assert stopped.value.code == 2


def test_lateness_is_taken_off_where_the_class_list_says_so(listed: Classroom, capsys):
    assert listed.run("grade", "--trust-times", str(listed.work)) == 0
    with (listed.grades / "grades.csv").open() as file:
        rows = {row["student"]: row for row in csv.DictReader(file)}
    assert (rows["ada"]["late_days"], rows["ada"]["total"]) == ("1", "9")
    assert rows["boole"]["late_days"] == "0"
    assert float(rows["'=curie"]["late_deduction"]) == 0.5 * 5.5  # at most half of 5.5
    assert "1 day late" in (listed.grades / "feedback/ada.html").read_text()


def test_a_class_list_elsewhere_is_remembered(classroom: Classroom, tmp_path: Path, capsys):
    (tmp_path / "list.toml").write_text(CLASS)
    given = ["--class-list", str(tmp_path / "list.toml")]
    assert classroom.run("grade", *given, str(classroom.work)) == 0
    assert classroom.run("export", "--format", "canvas") == 0
    (tmp_path / "list.toml").unlink()
    assert classroom.run("export", "--format", "canvas") == 1
    assert "no class list" in capsys.readouterr().err


@pytest.mark.parametrize("table", ["[late]\n", "[late]\ngrace_minutes = 3\n"])
def test_a_broken_class_list_is_said_before_anything_is_graded(
    listed: Classroom, table: str, capsys: pytest.CaptureFixture[str]
):
    (listed.grades / "class.toml").write_text(table)
    now = time.time()
    os.utime(listed.grades / "gradebook.db", (now, now))
    assert listed.run("grade", "--regrade", str(listed.work)) == 1
    assert "class.toml, line 1: in late, the field 'due' is missing" in capsys.readouterr().err


def test_release_says_what_the_bundle_holds(classroom: Classroom, tmp_path: Path, capsys):
    from autograder.cli import main

    course = ["--course", str(classroom.course.root)]
    assert main([*course, "release", str(tmp_path / "bundle")]) == 0
    assert "holds 1 notebooks" in capsys.readouterr().out
    assert main([*course, "release", str(tmp_path / "bundle")]) == 2
    assert "is not empty" in capsys.readouterr().err
    assert main([*course, "release", str(tmp_path / "practice"), "--practice"]) == 0
    assert (tmp_path / "practice/practice/solutions/answers/orchard.toml").exists()


def test_reports_name_the_missing_sandbox(classroom: Classroom, capsys):
    assert classroom.run("grade", "--no-sandbox", "--regrade", str(classroom.work)) == 0
    assert "nothing holds student code back" in capsys.readouterr().err
    for name in ("class.html", "feedback/ada.html", "grades.csv"):
        assert "--no-sandbox" in (classroom.grades / name).read_text()
