"""The sample class, graded once from the command line: what each of the twelve must come to.

Questions are named by id; those that the course may gain later are covered by "all the others".
"""

import csv
import subprocess
import sys
from pathlib import Path

import pytest

from autograder.cli import main
from autograder.course import load_course
from autograder.gradebook import Gradebook
from autograder.marking import Mark

ROOT = Path(__file__).parent.parent
SAMPLE = ROOT / "solutions/sample_class"
COURSE = load_course(ROOT)
STUDENTS = [
    *("ada", "boole", "curie", "dijkstra", "euler", "fourier"),
    *("gauss", "hopper", "ito", "jacobi", "kepler", "lovelace"),
]
COMMAND = ["--course", str(ROOT), "grade", str(SAMPLE), "--jobs", "2"]
BUILT_ON_FIT_LINE = ("Q2.4",)  # its right solution calls the student's own fit_line
Marks = dict[str, dict[str, Mark]]


@pytest.fixture(scope="module")
def out(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("grades")
    assert main([*COMMAND, "--out", str(folder), "--seed", "5"]) == 0
    return folder


@pytest.fixture(scope="module")
def marks(out) -> Marks:
    with Gradebook(out / "gradebook.db") as book:
        return {
            record.graded.submission.student: {mark.question: mark for mark in record.graded.marks}
            for record in book.records()
        }


@pytest.fixture(scope="module")
def rows(out) -> dict[str, dict[str, str]]:
    with (out / "grades.csv").open(newline="", encoding="utf-8") as file:
        return {row["student"]: row for row in csv.DictReader(file)}


def in_chapter(number: str) -> list[str]:
    return [id for id in COURSE.questions if id.startswith(f"Q{number}")]


def all_right_but(marks: dict[str, Mark], *changed: str) -> None:
    others = {id: mark.status for id, mark in marks.items() if id not in changed}
    assert others == dict.fromkeys(others, "right")


def recognised(marks: dict[str, Mark]) -> dict[str, str | None]:
    return {id: mark.alternative for id, mark in marks.items() if mark.status != "right"}


def test_everybody_is_there_with_every_question(marks):
    assert sorted(marks) == sorted(STUDENTS)
    for student in STUDENTS:
        assert list(marks[student]) == list(COURSE.questions)


def test_the_solved_notebooks_get_full_marks(marks, rows):
    all_right_but(marks["ada"])
    assert rows["ada"]["total"] == rows["ada"]["max"]


def test_the_blank_notebooks_get_nothing_and_nothing_is_attempted(marks, rows):
    assert {mark.status for mark in marks["boole"].values()} == {"not attempted"}
    assert rows["boole"]["total"] == "0"


def test_half_done_is_half_not_attempted(marks):
    ids = list(COURSE.questions)
    for position, id in enumerate(ids):
        expected = "not attempted" if position % 2 else "right"
        assert marks["curie"][id].status == expected, id


def test_wrong_calls_and_an_order_with_the_query_first(marks):
    mine = marks["dijkstra"]
    all_right_but(mine, "Q1.1", "Q1.2", "Q2.1", "Q3.1")
    assert mine["Q1.1"].points == 2  # true, true; the third is wrong, the fourth open
    assert mine["Q2.1"].points == 1
    assert mine["Q3.1"].points == 2
    assert mine["Q1.2"].alternative == "the test image before the tree is ready"
    assert mine["Q1.2"].points == 5  # 6 points, one of 12 cards lifted: 1 - 2/12


def test_the_typical_slips_in_numbers_are_named(marks):
    assert recognised(marks["euler"]) == {
        "Q3.2.1": "w instead of w squared",
        "Q3.2.2": "ordered pairs",
        "Q3.2.3b": "probability of success",
        "Q3.2.4": "probability of failure",
        "Q3.2.5": "rounded down",
    }


def test_the_typical_slips_in_expressions_are_named(marks):
    assert recognised(marks["fourier"]) == {
        "Q2.2a": "factor 2 lost",
        "Q2.2b": "not divided by N",
        "Q2.2c": "mixed term lost",
        "Q2.2d": "not usable",
        "Q2.2f2": "plain arctan",
        "Q3.2.3a": "only two outliers count",
    }
    assert "without quotes" in marks["fourier"]["Q2.2d"].feedback
    assert marks["fourier"]["Q2.2e"].alternative == "right, plain arctan"


def test_the_typical_slips_in_functions_are_named(marks):
    mine = marks["gauss"]
    all_right_but(mine, "Q2.3", "Q3.3", "Q3.7a", *BUILT_ON_FIT_LINE)  # Q3.7a calls Q3.3
    assert mine["Q2.3"].alternative.startswith("keeps a negative radius")
    assert mine["Q3.3"].alternative == "rounds down, edges forgotten"


def test_a_cell_that_raises_costs_its_own_question_only(marks):
    mine = marks["hopper"]
    all_right_but(mine, "Q2.3", "Q3.2.4", *BUILT_ON_FIT_LINE)
    assert (mine["Q2.3"].status, mine["Q3.2.4"].status) == ("error", "error")
    assert "AttributeError" in mine["Q2.3"].feedback + mine["Q2.3"].told
    assert "success_after_100" in mine["Q3.2.4"].feedback


def test_a_deleted_cell_is_not_attempted_and_of_copies_the_last_counts(marks):
    mine = marks["ito"]
    all_right_but(mine, "Q3.2.2")
    assert mine["Q3.2.2"].status == "not attempted"
    assert mine["Q3.2.1"].status == "right"  # the first copy says 12


def test_a_bare_notebook_is_its_chapter_and_the_others_were_not_handed_in(marks):
    mine = marks["jacobi"]
    assert {mine[id].status for id in in_chapter("3")} == {"right"}
    assert {mine[id].status for id in in_chapter("1") + in_chapter("2")} == {"not attempted"}


def test_a_folder_counts_like_a_zip(marks):
    all_right_but(marks["kepler"])


def test_what_is_no_submission_is_unreadable_and_says_why(marks, rows):
    for mark in marks["lovelace"].values():
        assert (mark.status, mark.points) == ("unreadable", 0)
        assert "neither a zip nor a notebook" in mark.feedback
    assert rows["lovelace"]["status"] == "unreadable"
    assert rows["lovelace"]["total"] == "0"


def test_grades_csv_has_a_column_a_question_and_totals_that_add_up(rows):
    most = sum(question.points for question in COURSE.questions.values())
    for row in rows.values():
        header = list(row)
        ids = header[1 : 1 + len(COURSE.questions)]
        assert header[0] == "student"
        assert ids == list(COURSE.questions)
        assert {"total", "max", "status"} <= set(header[1 + len(ids) :])
        assert float(row["total"]) == pytest.approx(sum(float(row[id] or 0) for id in ids))
        assert float(row["max"]) == most


def test_a_second_run_runs_nobody_again_and_changes_no_grade(out, rows, monkeypatch):
    def unexpected(self: object) -> None:
        raise AssertionError("a submission was run again")

    monkeypatch.setattr("autograder.sandbox.launcher.Sandbox.session", unexpected)
    before = (out / "grades.csv").read_bytes()
    assert main([*COMMAND, "--out", str(out)]) == 0
    assert (out / "grades.csv").read_bytes() == before


def test_the_committed_sample_class_is_that_of_the_notebooks():
    done = subprocess.run(
        [sys.executable, "-m", "solutions.make_sample_class", "--check"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout) == (0, "")
