"""What somebody who meets the commands for the first time is told, and could not guess."""

from __future__ import annotations

from pathlib import Path

import pytest

from autograder.cli import grading_run, main
from tests.toy import Toy


def test_a_large_file_of_the_data_is_named_when_it_is_handed_out(
    toy: Toy, tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    (toy.root / "data").mkdir(exist_ok=True)
    (toy.root / "data/small.csv").write_text("1\n")
    with (toy.root / "data/Messung Ü").open("wb") as file:
        file.truncate(30_000_000)
    assert main(["--course", str(toy.root), "release", str(tmp_path / "bundle")]) == 0
    said = capsys.readouterr().out
    assert "data/Messung Ü has 30 MB, and every student downloads it" in said
    assert "small.csv has" not in said


def test_a_check_says_that_the_notebooks_are_older_than_the_masters(
    toy: Toy, capsys: pytest.CaptureFixture[str]
):
    check = ["--course", str(toy.root), "check", "--without-mutants"]
    toy.write_notebooks()
    assert main(check) == 0
    assert "autograder build" not in capsys.readouterr().out
    toy.replace("notebooks/questions/kitchen.toml", "Walk around it.", "Walk along it.")
    assert main(check) == 0
    assert "notebooks/1_kitchen.ipynb is not what the masters give" not in capsys.readouterr().out
    toy.replace("notebooks/questions/kitchen.toml", "Three boxes", "Three large boxes")
    assert main(check) == 0
    said = capsys.readouterr().out
    assert "notebooks/1_kitchen.ipynb is not what the masters give: autograder build." in said
    assert said.endswith("The course is sound: 6 questions prove themselves.\n")


def test_libraries_that_every_start_compiles_anew_are_named_when_grading(
    classroom, monkeypatch, capsys
):
    """As in an environment that was copied and may not be written, on a shared machine."""
    monkeypatch.setattr(grading_run, "never_renewed", lambda: Path("/srv/python/site-packages"))
    assert classroom.run("grade", str(classroom.work)) == 0
    said = " ".join(capsys.readouterr().err.split())
    assert "python -m compileall -q" in said
    assert "/srv/python/site-packages" in said
