"""Grading where the work lies: what the autograder writes there is nobody's work."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from autograder.cli import main
from autograder.course import Course
from tests.intake.classes import (
    PEOPLE,
    Download,
    canvas,
    github,
    gradescope,
    moodle,
    nbgrader,
    plain,
    put,
)

pytestmark = pytest.mark.usefixtures("nothing_runs")

REPORTS = (
    *(["export", "--format", format] for format in ("csv", "canvas", "moodle", "gradescope")),
    *(["feedback", "--for", system] for system in ("moodle", "canvas", "email", "folder")),
    ["similar"],
    ["override", "--write", "overrides.csv"],
)


@pytest.mark.parametrize(
    ("maker", "out"),
    [
        *((maker, ".") for maker in (moodle, canvas, gradescope, nbgrader, github, plain)),
        *((github, None), (plain, None), (moodle, "results")),
        *((maker, "results/week/monday") for maker in (moodle, canvas, nbgrader, github, plain)),
    ],
)
def test_a_second_run_in_the_folder_finds_the_same_students(
    course: Course,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    maker: Callable[[Path], Download],
    out: str | None,
):
    download = maker(tmp_path)
    monkeypatch.chdir(download.path)
    run = ["--course", str(course.root)]
    where = [] if out is None else ["--out", out]
    lists = ["--class-list", str(download.class_list)]

    def grade() -> tuple[set[str], str]:
        capsys.readouterr()
        assert main([*run, "grade", ".", "--json", *where, *lists]) == 0
        told = json.loads(capsys.readouterr().out)["intake"]
        wanting = [entry for entry in told["passed_over"] if entry["needs_person"]]
        assert [e for e in wanting if "onlinetext" not in e["path"]] == []
        return {entry["student"] for entry in told["submissions"]}, told["summary"]

    first = grade()
    assert len(first[0]) == 12
    for command in REPORTS:
        assert main([*run, *command, *where]) in (0, 1), command
    assert grade() == first


def test_a_student_who_hands_in_a_file_called_like_the_gradebook_is_a_student(
    course: Course, tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    for login in ("ada", "boole", "curie"):
        put(tmp_path / "work" / login / "3_orchard.ipynb", PEOPLE[0].book())
    put(tmp_path / "work/ada/gradebook.db", b"SQLite format 3")
    put(tmp_path / "work/boole/grades/gradebook.db", b"SQLite format 3")
    where = [str(tmp_path / "work"), "--json", "--out", str(tmp_path / "grades")]
    assert main(["--course", str(course.root), "intake", *where]) == 0
    told = json.loads(capsys.readouterr().out)
    assert [entry["student"] for entry in told["submissions"]] == ["ada", "boole", "curie"]
