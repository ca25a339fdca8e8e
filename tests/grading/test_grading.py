"""Grading the toy course: what is run, what costs what, what is kept, and the exit status."""

import csv
import io
import json
import time
import zipfile
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from autograder.cli import main
from autograder.course import Settings
from autograder.grading.submission import grade_contents
from autograder.intake.submissions import Contents, Notebook
from autograder.marking import Mark
from autograder.marking.marker import Marker
from autograder.sandbox.launcher import Stopped
from autograder.sandbox.stop_errors import out_of_time
from tests.toy import Toy

RIGHT_ORDER = ["cup", "boil", "stir", "pour", "stir_again", "drink"]


class Scripted:
    """A sandbox without processes: what a student's process would send is written down here."""

    def __init__(self, run: Any = None, **replies: Any) -> None:
        self.run_reply, self.replies = run or {}, replies
        self.sessions = 0

    def session(self, deadline: float) -> "Scripted":
        self.sessions += 1
        return self

    def __enter__(self) -> "Scripted":
        return self

    def __exit__(self, *exception: object) -> None:
        pass

    def run(self, cells: list[str], names: list[str]) -> Any:
        if isinstance(self.run_reply, Exception):
            raise self.run_reply
        return self.run_reply

    def evaluate(self, name: str, probe: dict[str, Any]) -> Any:
        reply = self.replies.get(name, {"state": "unusable", "reason": "missing"})
        if isinstance(reply, Exception):
            raise reply
        return reply


def grade(course: Toy, sandbox: Scripted, contents: Contents) -> dict[str, Mark]:
    marks = grade_contents(contents, Marker(course.load(), seed=1), sandbox)  # type: ignore[arg-type]
    assert [mark.question for mark in marks] == list(course.load().questions)
    return {mark.question: mark for mark in marks}


def kitchen(*cells: str, **contents: Any) -> Contents:
    return Contents({"kitchen": Notebook(list(cells) or ["eggs = 12"])}, **contents)


def statuses(marks: dict[str, Mark]) -> list[str]:
    return [mark.status for mark in marks.values()]


def test_values_come_from_the_process_and_choices_from_the_saved_responses(toy):
    sidecars = {"kitchen": {"Q1.2": {"response": RIGHT_ORDER}}}
    sandbox = Scripted(
        {"responses": {"Q1.1": [True, False, True]}}, eggs={"state": "given", "value": 12}
    )
    marks = grade(toy, sandbox, kitchen(sidecars=sidecars))
    assert [marks[f"Q1.{n}"].status for n in (1, 2, 3)] == ["right"] * 3
    assert marks["Q1.4"].status == "not attempted"


def test_the_saved_response_beats_the_code_and_the_code_beats_the_receipt(toy):
    wrong, partly, right = [False, True, False], [True, True, True], [True, False, True]
    receipts = {"Q1.1": wrong}
    book = {"kitchen": Notebook(["ask"], receipts)}
    only_receipt = grade(toy, Scripted(), Contents(book))
    with_code = grade(toy, Scripted({"responses": {"Q1.1": partly}}), Contents(book))
    with_all = grade(
        toy,
        Scripted({"responses": {"Q1.1": partly}}),
        Contents(book, sidecars={"kitchen": {"Q1.1": {"response": right}}}),
    )
    assert [marks["Q1.1"].points for marks in (only_receipt, with_code, with_all)] == [0, 2, 3]


@pytest.mark.parametrize("status", ["timeout", "killed"])
def test_a_stopped_notebook_is_no_silent_zero(toy, status):
    """Only what was clicked before still counts."""
    contents = kitchen(sidecars={"kitchen": {"Q1.1": {"response": [True, False, True]}}})
    marks = grade(toy, Scripted(Stopped(status)), contents)
    assert statuses(marks) == ["right", status, status, status, status, "not attempted"]
    assert all(mark.points == 0 for id, mark in marks.items() if id != "Q1.1")


@pytest.mark.parametrize("status", ["timeout", "killed"])
def test_a_stopped_response_costs_one_question(toy, status):
    sandbox = Scripted(eggs=Stopped(status), rim={"state": "not attempted"})
    marks = grade(toy, sandbox, kitchen())
    assert (marks["Q1.3"].status, marks["Q1.4"].status) == (status, "not attempted")


def test_the_whole_submission_has_one_deadline_and_a_mark_says_when_it_had_passed(toy):
    deadlines = []

    class Watched(Scripted):
        def session(self, deadline: float) -> Scripted:
            deadlines.append(deadline)
            return super().session(deadline)

    late = out_of_time()
    course = replace(toy.load(), settings=Settings(submission_seconds=7))
    contents = Contents({"kitchen": Notebook(["1"]), "cellar": Notebook(["2"])})
    before = time.monotonic()
    marks = grade_contents(contents, Marker(course, seed=1), Watched(eggs=late, share=late))
    assert len(deadlines) == 2
    assert len(set(deadlines)) == 1
    assert before + 7 <= deadlines[0] <= time.monotonic() + 7
    said = {mark.question: (mark.status, mark.feedback) for mark in marks}
    assert (
        said["Q1.3"]
        == said["Q2.1"]
        == (
            "timeout",
            "It took longer than the time limit: the submission as a whole had used up its time.",
        )
    )


def test_an_unreadable_chapter_is_unreadable_in_every_kind_but_for_saved_choices(toy):
    contents = Contents(
        {},
        sidecars={"kitchen": {"Q1.2": {"response": RIGHT_ORDER}}},
        unreadable={"kitchen": "1_kitchen.ipynb is cut off."},
    )
    marks = grade(toy, Scripted(), contents)
    expected = ["unreadable", "right", "unreadable", "unreadable", "unreadable", "not attempted"]
    assert statuses(marks) == expected
    assert marks["Q1.3"].feedback == "1_kitchen.ipynb is cut off."


def test_a_name_that_is_missing_because_its_cell_raised_is_an_error(toy):
    contents = kitchen("eggs = 3 * four", "rim = 2")
    report = {"errors": ["NameError", None]}
    marks = grade(toy, Scripted(report), contents)
    assert marks["Q1.3"].status == "error"
    assert "The cell that should define eggs raised" in marks["Q1.3"].feedback
    assert marks["Q1.4"].status == "not attempted"


@pytest.mark.parametrize("cell", ["def mean_weight(w):\n    1/0", "eggs: int = x", "eggs = x"])
def test_a_defining_cell_is_found_in_any_form(toy, cell):
    marks = grade(toy, Scripted({"errors": ["NameError"]}), kitchen(cell))
    assert list(statuses(marks)).count("error") == 1


@pytest.mark.parametrize(
    "filling", ["\n", " ", " \n", "\t\n ", "def\n", "def ", "eggs ", "eggs:\n"]
)
def test_a_long_cell_that_defines_nothing_is_searched_at_once(toy, filling):
    began = time.process_time()
    marks = grade(toy, Scripted({"errors": ["E"]}), kitchen(filling * 100_000 + "1 / 0"))
    assert time.process_time() - began < 5  # of this process alone
    assert marks["Q1.3"].status == "not attempted"


@pytest.mark.parametrize(
    "report",
    [
        {"errors": 3, "responses": [], "understood": 7},
        {"errors": [{}], "responses": {"Q1.1": {}}, "understood": {"eggs": [1]}},
        {"responses": {"Q1.1": "ttf", "Q1.2": [None]}},
    ],
)
def test_a_report_of_any_shape_is_survived(toy, report):
    marks = grade(toy, Scripted(report, eggs={"state": "given", "value": 12}), kitchen())
    assert marks["Q1.3"].status == "right"
    assert sum(mark.points for mark in marks.values()) == 2


def test_a_notebook_of_any_name_is_known_by_the_questions_it_asks(toy):
    book = Contents({"homework": Notebook(['check("Q2.1", share)'])})
    sandbox = Scripted(share={"state": "given", "value": 1 / 3})
    assert grade(toy, sandbox, book)["Q2.1"].status == "right"


def test_only_the_questions_asked_for_are_marked_and_other_chapters_not_run(toy):
    sandbox = Scripted(share={"state": "given", "value": 0.33})
    marker = Marker(toy.load(), seed=1)
    book = Contents({"kitchen": Notebook(["1"]), "cellar": Notebook(["2"])})
    marks = grade_contents(book, marker, sandbox, frozenset({"Q2.1"}))  # type: ignore[arg-type]
    assert [(mark.question, mark.status) for mark in marks] == [("Q2.1", "right")]
    assert sandbox.sessions == 1


# From the command line, in real processes.


def zipped(path: Path, notebooks: dict[str, list[dict[str, Any]]]) -> None:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for name, cells in notebooks.items():
            book = {"cells": cells, "metadata": {}, "nbformat": 4, "nbformat_minor": 5}
            archive.writestr(name, json.dumps(book))
    path.write_bytes(buffer.getvalue())


def grades(out: Path) -> dict[str, dict[str, str]]:
    with (out / "grades.csv").open(newline="", encoding="utf-8") as file:
        return {row["student"]: row for row in csv.DictReader(file)}


@pytest.fixture
def handed_in(toy, tmp_path) -> Path:
    """One student, everything right."""
    toy.write_notebooks()
    folder = tmp_path / "class"
    folder.mkdir()
    cells = {f"{stem}.ipynb": toy.solved_cells(stem) for stem in ("1_kitchen", "2_cellar")}
    zipped(folder / "ada.zip", cells)
    return folder


def test_grading_resumes_and_runs_again_only_what_changed(
    toy, handed_in, tmp_path, monkeypatch, capsys
):
    from autograder.sandbox.launcher import Sandbox

    sessions = []
    session = Sandbox.session

    def counted(self: Sandbox, deadline: float) -> Any:
        sessions.append(1)
        return session(self, deadline)

    monkeypatch.setattr(Sandbox, "session", counted)
    out = tmp_path / "out"
    command = [
        "--course",
        str(toy.root),
        "grade",
        str(handed_in),
        "--out",
        str(out),
        "--jobs",
        "1",
    ]
    assert main(command) == 0
    assert grades(out)["ada"]["total"] == grades(out)["ada"]["max"] == "19"
    assert len(sessions) == 2  # one a chapter
    assert main(command) == 0
    assert len(sessions) == 2
    # A second student: only that one is run.
    zipped(handed_in / "boole.zip", {"2_cellar.ipynb": toy.solved_cells("2_cellar")})
    assert main(command) == 0
    assert [row["total"] for row in grades(out).values()] == ["19", "1"]
    assert 2 < len(sessions) <= 4
    before = len(sessions)
    # Another key: everybody is marked again.
    toy.replace("solutions/answers/cellar.toml", "credit = 1.0", "credit = 0.5\nfeedback = 'x'")
    assert main(command) == 0
    assert len(sessions) > before
    assert grades(out)["boole"]["total"] == "0.5"


def test_an_error_of_the_graders_own_costs_one_submission_and_says_so(
    toy, handed_in, tmp_path, monkeypatch, capsys
):
    """Whatever a submission may yet find to break, the next one is graded."""
    from autograder.grading import submission as grading
    from autograder.grading import whole_class

    zipped(handed_in / "boole.zip", {"2_cellar.ipynb": toy.solved_cells("2_cellar")})
    zipped(handed_in / "cantor.zip", {"2_cellar.ipynb": toy.solved_cells("2_cellar")})
    zipped(handed_in / "dedekind.zip", {"2_cellar.ipynb": toy.solved_cells("2_cellar")})
    broken = {"boole", "cantor"}
    read, mark = whole_class.read_submission, grading.grade_contents

    def read_or_fail(submission: Any, *arguments: Any) -> Any:
        if submission.student == "boole" and broken:
            raise TypeError("the text of a student")
        contents = read(submission, *arguments)
        contents.notes.append(submission.student)
        return contents

    def mark_or_fail(contents: Any, *arguments: Any) -> Any:
        if "cantor" in contents.notes and broken:
            raise ValueError("the truth value of an array")
        return mark(contents, *arguments)

    monkeypatch.setattr(whole_class, "read_submission", read_or_fail)
    monkeypatch.setattr(grading, "grade_contents", mark_or_fail)
    out = tmp_path / "out"
    command = ["--course", str(toy.root), "grade", str(handed_in), "--out", str(out)]
    assert main(command) == 0
    totals = {student: row["total"] for student, row in grades(out).items()}
    assert totals == {"ada": "19", "boole": "0", "cantor": "0", "dedekind": "1"}
    pages = {name: (out / f"feedback/{name}.html").read_text("utf-8") for name in totals}
    assert "The autograder itself failed on this submission (ValueError in" in pages["cantor"]
    assert "The autograder itself failed on this submission (TypeError in" in pages["boole"]
    assert "the text of a student" not in pages["boole"]
    # It is not taken for graded: the next run tries again.
    broken.clear()
    assert main(command) == 0
    assert [row["total"] for row in grades(out).values()] == ["19", "1", "1", "1"]


def test_a_broken_machine_stops_the_run(toy, handed_in, tmp_path, monkeypatch, capsys):
    from autograder.grading import submission as grading
    from autograder.sandbox.launcher import SandboxError

    def fail(*arguments: Any) -> Any:
        raise SandboxError("Nothing works here.")

    monkeypatch.setattr(grading, "grade_contents", fail)
    out = str(tmp_path / "out")
    command = ["--course", str(toy.root), "grade", str(handed_in), "--out", out]
    assert main(command) == 1
    assert "Nothing works here." in capsys.readouterr().err


WRONG_USAGE = [
    ["grade"],
    ["mark", "x"],
    [],
    ["grade", "nowhere"],
    ["grade", ".", "--jobs", "0"],
    ["grade", ".", "--question", "Q9"],
]


@pytest.mark.parametrize("arguments", WRONG_USAGE)
def test_wrong_usage_exits_with_2_and_one_sentence(toy, tmp_path, monkeypatch, capsys, arguments):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.zip").write_bytes(b"")
    try:
        status = main(["--course", str(toy.root), *arguments])
    except SystemExit as exit:
        status = exit.code
    assert status == 2
    said = capsys.readouterr().err
    assert "Traceback" not in said
    assert said.strip()


@pytest.mark.parametrize("command", [["grade", "."], ["check"], ["build", "--check"]])
def test_a_broken_course_exits_with_1(toy, tmp_path, monkeypatch, capsys, command):
    monkeypatch.chdir(tmp_path)
    toy.replace("notebooks/questions/kitchen.toml", 'id = "Q1.3"', 'id = "Q1.4"')
    assert main(["--course", str(toy.root), *command]) == 1
    captured = capsys.readouterr()
    assert "two questions have this id" in captured.err + captured.out
