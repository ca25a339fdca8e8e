"""Grades for other systems, held against what those systems' own documentation asks for.

Canvas: the importer's source (lib/gradebook_importer.rb, instructure/canvas-lms) fixes the header.
Moodle: docs.moodle.org, "Grade import". Gradescope: its autograder specification.
"""

from __future__ import annotations

import csv
import json
import os
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import pytest

from autograder.course import Course, load_course
from autograder.gradebook import Override, Record
from autograder.intake.class_list import ClassList
from autograder.intake.person import Person
from autograder.release.gradescope.package import write_autograder_zip
from autograder.release.gradescope.results import failure, results
from autograder.release.gradescope.run import main as grade_in_gradescope
from autograder.reports.exports import alike_for_canvas, write_canvas, write_moodle, write_plain
from tests.classroom import RIGHT, START, all_marks, graded, hostile_mark, notebook

FORMULA = '=HYPERLINK("http://example.org")'


@pytest.fixture
def listed() -> ClassList:
    return ClassList(
        (
            Person("Ada Lovelace", "11", "S-1", "ada", "ada@example.org", "A"),
            Person("George Boole", "12", "S-2", "boole", "boole@example.org", "B"),
            Person(FORMULA, "13", "S-3", "eve", "eve@example.org", "@B"),
            Person("Nobody There", "14", "S-4", "absent", "absent@example.org", "B"),
        ),
        title="Orchard",
        canvas_id="4711",
    )


@pytest.fixture
def records() -> list[Record]:
    return [
        Record(graded("ada", *all_marks()), 1, 1),
        Record(graded("boole", *all_marks((0.5, 1, 0, 0.25))), 1, 1, late_days=1, late_percent=10),
        Record(graded("eve", *all_marks((0, 0, 0, 0))), 1, 1),
        Record(graded("stranger", *all_marks()), 1, 1),
    ]


def rows(path: Path) -> list[list[str]]:
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.reader(file))


def test_canvas_finds_its_header_its_points_and_its_students(
    tmp_path: Path, course: Course, listed: ClassList, records: list[Record]
):
    left = write_canvas(tmp_path / "canvas.csv", course, listed, records)
    header, possible, *students = rows(tmp_path / "canvas.csv")
    # row_has_student_headers?, update_column_count and header? of the importer:
    assert len(header) > 3
    assert "Student" in header[0]
    assert "ID" in header[1]
    assert header[2:5] == ["SIS User ID", "SIS Login ID", "Section"]
    assert header[5] == "Orchard (4711)"  # Assignment.title_and_id reads the number
    assert "Points Possible" in possible[0]
    assert possible[5] == "10"
    assert students[0] == ["Ada Lovelace", "11", "S-1", "ada", "A", "10"]
    # 1 + 2 + 0 + 1 = 4, a tenth off for a day
    assert students[1][5] == "3.6"
    assert students[2][0] == "'" + FORMULA
    assert students[2][4] == "'@B"
    assert students[3][5] == ""
    assert [record.student for record in left] == ["stranger"]


def test_moodle_can_tell_users_and_gets_grades_with_their_feedback(
    tmp_path: Path, course: Course, listed: ClassList, records: list[Record]
):
    write_moodle(tmp_path / "moodle.csv", course, listed, records)
    header, *students = rows(tmp_path / "moodle.csv")
    assert {"Username", "ID number", "Email address"} <= set(header)
    grade = header.index("Orchard")
    assert "Orchard feedback" in header
    assert len(students) == 3  # who handed in nothing keeps the grade that Moodle has
    assert all(float(row[grade]) <= 100 for row in students)
    assert all(row[header.index("Email address")] for row in students)
    assert "Q4 1/4; 1 days late" in students[1][header.index("Orchard feedback")]


def test_the_plain_table_leaves_nobody_out(
    tmp_path: Path, course: Course, listed: ClassList, records: list[Record]
):
    write_plain(tmp_path / "all.csv", course, listed, records)
    header, *people = rows(tmp_path / "all.csv")
    by_name = {row[1] or row[0]: dict(zip(header, row, strict=True)) for row in people}
    assert by_name["Nobody There"]["status"] == "not handed in"
    assert by_name["stranger"]["total"] == "10"
    assert by_name["George Boole"]["earned"] == "4"
    assert by_name["George Boole"]["late_deduction"] == "0.4"
    assert all(not cell.startswith(("=", "+", "@")) for row in people for cell in row)


# Gradescope


def assert_gradescope_accepts(document: dict[str, Any]) -> None:
    """The rules of the specification for results.json."""
    visibilities = {"hidden", "after_due_date", "after_published", "visible"}
    formats = {"text", "html", "simple_format", "md", "ansi"}
    known = {
        "score": (int, float),
        "execution_time": (int, float),
        "output": str,
        "output_format": str,
        "test_output_format": str,
        "test_name_format": str,
        "visibility": str,
        "stdout_visibility": str,
        "extra_data": dict,
        "tests": list,
        "leaderboard": list,
    }
    known_of_test = {
        "score": (int, float),
        "max_score": (int, float),
        "status": str,
        "name": str,
        "name_format": str,
        "number": str,
        "output": str,
        "output_format": str,
        "tags": list,
        "visibility": str,
        "extra_data": dict,
    }
    assert "score" in document or all("score" in test for test in document["tests"])
    for table, kinds in [(document, known), *((t, known_of_test) for t in document["tests"])]:
        for key, value in table.items():
            assert isinstance(value, kinds[key]), key  # type: ignore[arg-type]
            if "visibility" in key:
                assert value in visibilities
            if key.endswith("format"):
                assert value in formats
            if key == "status":
                assert value in {"passed", "failed"}


def test_gradescope_gets_a_test_for_each_question(course: Course):
    override = Override("ada", "Q2", 1.5, "oral", "")
    record = Record(
        graded("ada", *all_marks((1, 0, 0.5, 1))),
        1,
        1,
        {"Q2": override},
        late_days=1,
        late_percent=10,
    )
    document = results(course, record)
    assert_gradescope_accepts(document)
    assert [test["score"] for test in document["tests"]] == [2, 1.5, 1, 4]
    assert sum(test["max_score"] for test in document["tests"]) == 10
    assert document["score"] == pytest.approx(8.5 * 0.9)
    assert "oral" in document["tests"][1]["output"]
    assert document["stdout_visibility"] == "hidden"


def test_gradescope_gets_hostile_text_as_plain_text(course: Course):
    text = "<script>\x1b[31m\x00\ud800"
    document = results(course, Record(graded(text, hostile_mark("Q1", text), notes=(text,)), 1, 1))
    assert_gradescope_accepts(document)
    shown = json.dumps(document)
    assert "\\u001b" not in shown
    assert "\\ud800" not in shown
    assert "html" not in {document["output_format"], document["test_output_format"]}


def test_explanations_reach_gradescope_only_where_they_are_allowed(course: Course):
    record = Record(graded("ada", hostile_mark("Q1", "Because.")), 1, 1)
    allowed, not_allowed = (
        results(course, record, explanations)["tests"][0]["output"].count("Because.")
        for explanations in (True, False)
    )
    assert allowed == not_allowed + 1


def test_a_failure_still_makes_results(course: Course):
    assert_gradescope_accepts(failure("the disk is full", 10))


@pytest.fixture(scope="module")
def unpacked(course: Course, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What Gradescope makes of autograder.zip: the folder /autograder/source."""
    root = tmp_path_factory.mktemp("gradescope") / "autograder"
    root.mkdir()
    write_autograder_zip(root.parent / "autograder.zip", course)
    with zipfile.ZipFile(root.parent / "autograder.zip") as archive:
        modes = {entry.filename: entry.external_attr >> 16 for entry in archive.infolist()}
        assert modes["setup.sh"] == modes["run_autograder"] == 0o755
        archive.extractall(root / "source")
    return root


def test_the_archive_has_what_gradescope_looks_for_at_its_root(unpacked: Path):
    for name in ("setup.sh", "run_autograder"):
        text = (unpacked / "source" / name).read_text()
        assert text.startswith("#!")
        subprocess.run(["bash", "-n", str(unpacked / "source" / name)], check=True)
    assert (unpacked / "source/course/solutions/answers/orchard.toml").is_file()
    assert (unpacked / "source/course/pyproject.toml").is_file()
    assert not list((unpacked / "source").rglob("*.ipynb"))


def test_the_chapters_keep_their_order_in_the_archive(tmp_path: Path):
    course = load_course(Path(__file__).parents[2])
    write_autograder_zip(tmp_path / "autograder.zip", course)
    with zipfile.ZipFile(tmp_path / "autograder.zip") as archive:
        archive.extractall(tmp_path)
    assert list(load_course(tmp_path / "course").questions) == list(course.questions)


def test_the_archive_grades_a_submission_as_it_would_there(course: Course, unpacked: Path):
    (unpacked / "submission").mkdir()
    cells = [START, *RIGHT.values(), "print('hello')"]
    (unpacked / "submission/3_orchard.ipynb").write_text(notebook(cells))
    (unpacked / "submission_metadata.json").write_text('{"users": [{"name": "Ada"}]}')
    # The archive brings the course's modules; only the orchard's reference lies beside it here.
    reference = (course.root / "orchard_reference.py").read_text()
    (unpacked / "source/course/orchard_reference.py").write_text(reference)
    done = subprocess.run(
        [sys.executable, "-m", "autograder.release.gradescope.run", "--root", str(unpacked)],
        env={**os.environ, "PYTHONPATH": str(unpacked / "source/course")},
        cwd=unpacked,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    document = json.loads((unpacked / "results/results.json").read_text())
    assert_gradescope_accepts(document)
    assert document["score"] == 10, done.stdout


def test_results_are_written_even_if_grading_breaks(tmp_path: Path, capsys):
    (tmp_path / "submission").mkdir()
    arguments = ["--root", str(tmp_path), "--course", str(tmp_path / "no course")]
    assert grade_in_gradescope(arguments) == 0
    document = json.loads((tmp_path / "results/results.json").read_text())
    assert_gradescope_accepts(document)
    assert "not your fault" in document["output"]
    assert "Traceback" in capsys.readouterr().out


def test_canvas_gets_nobody_of_whom_it_knows_a_name_that_another_has_too(
    tmp_path: Path, course: Course, records: list[Record]
):
    listed = ClassList(
        (
            Person("Ada Lovelace", email="ada@example.org"),
            Person("Ada Lovelace", email="other@example.org"),
            Person("George Boole", email="boole@example.org"),
        )
    )
    write_canvas(tmp_path / "canvas.csv", course, listed, records)
    assert [row[0] for row in rows(tmp_path / "canvas.csv")[2:]] == ["George Boole"]
    assert [person.email for person in alike_for_canvas(listed)] == [
        "ada@example.org",
        "other@example.org",
    ]
