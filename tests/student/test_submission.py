"""`submit`: the zip that is handed in."""

from __future__ import annotations

import json
import zipfile
from pathlib import Path

import pytest

from autograder import ask, check, submit
from autograder.cli import main
from autograder.student import unsaved


def test_the_zip_holds_the_notebooks_and_the_responses(own_garden: Path):
    ask("Q1.1").respond([False, True])
    shown = submit()
    target = own_garden / "notebooks/submission.zip"
    with zipfile.ZipFile(target) as archive:
        assert archive.namelist() == ["1_garden.ipynb", "responses/garden.json", "submitted.txt"]
        kept = json.loads(archive.read("responses/garden.json"))
    assert kept["responses"]["Q1.1"]["response"] == [False, True]
    assert "Unanswered or not checked: 4 of 5 (Q1.2, Q1.3, Q1.4, Q1.5)" in repr(shown)


def test_nothing_is_listed_once_everything_is_answered(own_garden: Path):
    import sympy as sp

    w, length = sp.symbols("w l")
    ask("Q1.1").respond([False, True])
    ask("Q1.2").respond([2, 3, 1])
    check("Q1.3", 12)
    check("Q1.4", 2 * (w + length))
    check("Q1.5", sum)
    assert "All 5 questions are answered." in repr(submit())


def test_unfinished_work_may_be_handed_in(own_garden: Path):
    assert "Unanswered or not checked: 5 of 5" in repr(submit())
    assert (own_garden / "notebooks/submission.zip").exists()


def test_other_notebooks_and_copies_of_the_zip_stay_out(own_garden: Path):
    (own_garden / "notebooks/scratch.ipynb").write_text("{}")
    (own_garden / "notebooks/9_diary.ipynb").write_text("{}")
    submit()
    submit()
    with zipfile.ZipFile(own_garden / "notebooks/submission.zip") as archive:
        assert archive.namelist() == ["1_garden.ipynb", "submitted.txt"]


def test_no_notebook_to_hand_in_gets_one_sentence(
    own_garden: Path, capsys: pytest.CaptureFixture[str]
):
    (own_garden / "notebooks/1_garden.ipynb").unlink()
    assert submit() is None
    said = capsys.readouterr().out
    assert said.count("\n") == 1
    assert "There is no chapter of the course" in said


def test_a_zip_that_cannot_be_written_gets_one_sentence(
    own_garden: Path, capsys: pytest.CaptureFixture[str]
):
    (own_garden / "notebooks/submission.zip").mkdir()
    assert submit() is None
    said = capsys.readouterr().out
    assert said.count("\n") == 1
    assert "nothing was handed in" in said


def test_with_a_folder_of_its_own_for_responses_the_zip_goes_there(garden: Path):
    submit()
    assert (garden / "submission.zip").exists()


def test_a_renamed_notebook_is_known_by_its_questions_and_named(own_garden: Path):
    notebooks = own_garden / "notebooks"
    (notebooks / "1_garden.ipynb").rename(notebooks / "final version.ipynb")
    shown = submit()
    with zipfile.ZipFile(notebooks / "submission.zip") as archive:
        assert archive.namelist() == ["final version.ipynb", "submitted.txt"]
    assert "final version.ipynb" in repr(shown)


def test_a_drop_folder_takes_the_file_and_an_instructor_finds_it_with_its_time(
    own_garden: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
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
    own_garden: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr(unsaved, "_runs", {})
    unsaved.remember("ask", "bed_area = 12")
    said = repr(submit(to=str(tmp_path)))
    assert "Not ready to hand in" in said
    assert f"Nothing was put into {tmp_path}" in said
    assert list(tmp_path.glob("*.zip")) == []


def test_a_drop_folder_that_is_not_there_is_named(
    own_garden: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    assert submit(to=tmp_path / "none") is None
    assert "none is not a folder, so nothing was handed in" in capsys.readouterr().out
