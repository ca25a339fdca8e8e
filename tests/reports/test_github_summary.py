"""What GitHub shows of a graded repository."""

from __future__ import annotations

from pathlib import Path

import pytest

from autograder.cli import main
from autograder.questions.mark import Mark
from autograder.reports import github_summary
from tests.classroom import hand_in, make_course


class Graded:
    notes = ("a | b <script>",)

    def __init__(self, *marks: Mark) -> None:
        self.marks = marks


class Handed:
    name = "Ada <b>| Lovelace"
    total = 1.5
    open = ()
    scheme = None

    def __init__(self, *marks: Mark) -> None:
        self.graded = Graded(*marks)

    def points(self, question: str) -> float:
        return 0.5


def first_question(course) -> str:
    return next(iter(course.questions))


def test_a_remark_can_neither_end_its_command_nor_begin_another(real_course):
    id = first_question(real_course)
    mark = Mark(id, "wrong", 0.0, 2.0, "50 % of it,\n::set-output name=x::y\r")
    [line] = github_summary.remarks(real_course, Handed(mark), {"place_recognition": "a,b:c.ipynb"})
    assert "\n" not in line
    assert "\r" not in line
    head, _, said = line.removeprefix("::").partition("::")
    assert head.startswith("error file=a%2Cb%3Ac.ipynb,title=")
    assert said == "50 %25 of it,%0A::set-output name=x::y%0D"


@pytest.mark.parametrize(
    ("status", "level"),
    [("right", None), ("recorded", None), ("partial", "warning"), ("not attempted", "notice"),
     ("wrong", "error"), ("timeout", "error"), ("killed", "error")],
)  # fmt: skip
def test_what_is_right_gets_no_remark(real_course, status: str, level: str | None):
    mark = Mark(first_question(real_course), status, 0.0, 2.0, "Look again.")
    lines = list(github_summary.remarks(real_course, Handed(mark), {}))
    assert [line.split()[0] for line in lines] == ([] if level is None else [f"::{level}"])


def test_the_summary_is_one_table_whatever_the_texts_hold(real_course):
    mark = Mark(first_question(real_course), "partial", 0.25, 2.0, "a | b\n| c <img src=x>")
    text = github_summary.summary(real_course, Handed(mark))
    [row] = [line for line in text.splitlines() if line.startswith("| Q")]
    assert row.count("|") - row.count("\\|") == 5
    assert "<" not in text


def test_grading_writes_the_summary_and_the_remarks_at_the_notebooks(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
):
    make_course(tmp_path / "course")
    hand_in(tmp_path / "work", "boole", Q2="trees = 7", Q3="hedge = ...")
    monkeypatch.setenv("GITHUB_STEP_SUMMARY", str(tmp_path / "page.md"))
    monkeypatch.chdir(tmp_path)
    arguments = ["grade", "work", "--out", "grades", "--summary", "github"]
    assert main(["--course", str(tmp_path / "course"), *arguments]) == 0
    remarks = [line for line in capsys.readouterr().out.splitlines() if line.startswith("::")]
    [wrong] = [line for line in remarks if "title=Q2" in line]
    assert wrong.partition(",")[0].endswith(".ipynb")
    assert Path(wrong.partition("file=")[2].partition(",")[0]).is_file()
    assert not any("title=Q4" in line for line in remarks)
    page = (tmp_path / "page.md").read_text(encoding="utf-8")
    assert page.startswith("## boole")
    assert page.count("| Q") == 4
    assert "**6.5 of 10 points**" in page


def test_a_notebook_that_a_merge_has_damaged_does_not_end_the_grading_of_its_repository(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
):
    """In a student's repository the course's notebooks are the student's own."""
    make_course(tmp_path / "course")
    damaged = "<<<<<<< HEAD\n{}\n=======\n"
    for name in ("1_orchard.ipynb", "scratch.ipynb"):
        (tmp_path / "course/notebooks" / name).write_text(damaged, encoding="utf-8")
    hand_in(tmp_path / "work", "boole", Q2="trees = 7")
    monkeypatch.chdir(tmp_path)
    for command in (["grade", "work"], ["similar"]):
        assert main(["--course", str(tmp_path / "course"), *command, "--out", "grades"]) == 0
    assert "1_orchard.ipynb cannot be read as a notebook" in " ".join(
        capsys.readouterr().err.split()
    )
