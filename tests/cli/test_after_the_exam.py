"""After the exam, from the command line: differences first, then reports and exports follow."""

from __future__ import annotations

import csv
import json
import shutil

import pytest

from tests.classroom import hand_in
from tests.cli.conftest import Classroom


def totals(classroom: Classroom) -> dict[str, tuple[str, str]]:
    with (classroom.grades / "grades.csv").open() as file:
        return {row["student"]: (row["total"], row["max"]) for row in csv.DictReader(file)}


def test_nothing_changes_until_the_differences_were_accepted(classroom: Classroom, capsys):
    (classroom.grades / "grading.toml").write_text('given = ["Q3"]\n')
    before = totals(classroom)
    assert classroom.run("adjust") == 0
    out = capsys.readouterr().out
    assert "boole: 6.5 of 10 (65%) → 8.5 of 10 (85%)  (Q3)" in out
    assert "1 of 3 students see a difference" in out
    assert totals(classroom) == before
    assert classroom.run("adjust", "--accept") == 0
    assert totals(classroom)["boole"] == ("8.5", "10")
    assert "Everybody has the full points" in (classroom.grades / "feedback/ada.html").read_text()
    assert classroom.run("export", "--format", "csv") == 0
    with (classroom.grades / "csv.csv").open() as file:
        rows = {row["submission"]: row for row in csv.DictReader(file)}
    assert rows["boole"]["total"] == "8.5"
    assert classroom.run("adjust", "--withdraw", "--accept") == 0
    assert totals(classroom) == before


def test_a_scheme_holds_for_regrading_and_for_machines(classroom: Classroom, capsys):
    (classroom.grades / "grading.toml").write_text('dropped = ["Q4"]\n')
    assert classroom.run("adjust", "--accept", "--json") == 0
    told = json.loads(capsys.readouterr().out)
    assert told["max"] == {"before": 10, "after": 6}
    assert classroom.run("regrade", "boole") == 0
    assert totals(classroom)["boole"] == ("2.5", "6")
    assert classroom.run("show", "boole", "--json") == 0
    assert json.loads(capsys.readouterr().out.partition("\n{")[2].join(["{", ""]))["max"] == 6


def test_a_broken_scheme_changes_nothing_and_names_its_place(classroom: Classroom, capsys):
    (classroom.grades / "grading.toml").write_text('dropped = ["Q7"]\n')
    assert classroom.run("adjust", "--accept") == 1
    assert "grading.toml" in capsys.readouterr().err
    assert classroom.run("show", "ada") == 0


def test_without_a_scheme_the_command_says_what_to_write(classroom: Classroom, capsys):
    assert classroom.run("adjust") == 2
    assert "dropped" in capsys.readouterr().err


@pytest.mark.parametrize(("rule", "total"), [("newest", "8"), ("best", "10"), ("mean", "9")])
def test_a_resubmission_counts_as_the_scheme_says(classroom: Classroom, tmp_path, rule, total):
    work = tmp_path / "work"
    shutil.copytree(classroom.work, work)
    hand_in(work, "ada", Q2="trees = ...")  # 8 points, after 10
    assert classroom.run("grade", str(work)) == 0
    assert classroom.run("grade", str(work)) == 0  # the same again is no third attempt
    (classroom.grades / "grading.toml").write_text(f'[resubmission]\npoints = "{rule}"\n')
    assert classroom.run("adjust", "--accept") == 0
    assert totals(classroom)["ada"][0] == total


def test_a_question_without_points_is_marked_and_counts_nothing(classroom: Classroom, capsys):
    path = classroom.course.root / "notebooks/questions/orchard.toml"
    path.write_text(path.read_text().replace("points = 4", "points = 0"))
    assert classroom.run("grade", str(classroom.work)) == 0
    assert totals(classroom)["ada"] == ("6", "6")
    assert "0 of 0 points" in (classroom.grades / "feedback/ada.html").read_text()
    assert classroom.run("export", "--format", "csv") == 0
