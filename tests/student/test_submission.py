"""`submit`: the zip that is handed in."""

from __future__ import annotations

import json
import zipfile
from pathlib import Path

import pytest

from autograder import ask, check, submit
from autograder.cli import main
from autograder.student import unsaved


def test_the_zip_holds_the_notebooks_and_the_responses(own_orchard: Path):
    ask("Q1").respond([False, True])
    shown = submit()
    target = own_orchard / "notebooks/submission.zip"
    with zipfile.ZipFile(target) as archive:
        assert archive.namelist() == ["3_orchard.ipynb", "responses/orchard.json", "submitted.txt"]
        kept = json.loads(archive.read("responses/orchard.json"))
    assert kept["responses"]["Q1"]["response"] == [False, True]
    assert "Unanswered or not checked: 4 of 5 (Q2, Q3, Q4, Q5)" in repr(shown)


def test_nothing_is_listed_once_everything_is_answered(own_orchard: Path):
    import sympy as sp

    w, length = sp.symbols("w l")
    ask("Q1").respond([False, True])
    ask("Q5").respond([2, 3, 1])
    check("Q2", 12)
    check("Q3", 2 * (w + length))
    check("Q4", max)
    assert "All 5 questions are answered." in repr(submit())


def test_unfinished_work_may_be_handed_in(own_orchard: Path):
    assert "Unanswered or not checked: 5 of 5" in repr(submit())
    assert (own_orchard / "notebooks/submission.zip").exists()


def test_other_notebooks_and_copies_of_the_zip_stay_out(own_orchard: Path):
    (own_orchard / "notebooks/scratch.ipynb").write_text("{}")
    (own_orchard / "notebooks/9_diary.ipynb").write_text("{}")
    submit()
    submit()
    with zipfile.ZipFile(own_orchard / "notebooks/submission.zip") as archive:
        assert archive.namelist() == ["3_orchard.ipynb", "submitted.txt"]


def test_no_notebook_to_hand_in_gets_one_sentence(
    own_orchard: Path, capsys: pytest.CaptureFixture[str]
):
    (own_orchard / "notebooks/3_orchard.ipynb").unlink()
    assert submit() is None
    said = capsys.readouterr().out
    assert said.count("\n") == 1
    assert "There is no chapter of the course" in said


def test_a_zip_that_cannot_be_written_gets_one_sentence(
    own_orchard: Path, capsys: pytest.CaptureFixture[str]
):
    (own_orchard / "notebooks/submission.zip").mkdir()
    assert submit() is None
    said = capsys.readouterr().out
    assert said.count("\n") == 1
    assert "nothing was handed in" in said


def test_with_a_folder_of_its_own_for_responses_the_zip_goes_there(orchard: Path):
    submit()
    assert (orchard / "submission.zip").exists()


def test_a_renamed_notebook_is_known_by_its_questions_and_named(own_orchard: Path):
    notebooks = own_orchard / "notebooks"
    (notebooks / "3_orchard.ipynb").rename(notebooks / "final version.ipynb")
    shown = submit()
    with zipfile.ZipFile(notebooks / "submission.zip") as archive:
        assert archive.namelist() == ["final version.ipynb", "submitted.txt"]
    assert "final version.ipynb" in repr(shown)


def test_a_drop_folder_takes_the_file_and_an_instructor_finds_it_with_its_time(
    own_orchard: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    taking = tmp_path / "drop"
    taking.mkdir()
    taking.chmod(0o3773)
    said = repr(submit(to=taking))
    assert f"Handed in as {taking}" in said
    assert "Hand in this file" not in said
    assert main(["collect", str(taking), "--out", str(tmp_path / "class")]) == 0
    capsys.readouterr()
    assert main(["intake", "--json", str(tmp_path / "class")]) == 0
    [row] = json.loads(capsys.readouterr().out)["submissions"]
    assert row["time_from"] == "times.csv"


def test_a_drop_folder_gets_nothing_while_work_is_not_saved(
    own_orchard: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr(unsaved, "_runs", {})
    unsaved.remember("ask", "trees = 12")
    said = repr(submit(to=str(tmp_path)))
    assert "Not ready to hand in" in said
    assert f"Nothing was put into {tmp_path}" in said
    assert list(tmp_path.glob("*.zip")) == []


def test_a_drop_folder_that_is_not_there_is_named(
    own_orchard: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    assert submit(to=tmp_path / "none") is None
    assert "none is not a folder, so nothing was handed in" in capsys.readouterr().out
