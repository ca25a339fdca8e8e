"""What the command says where there is no course."""

from __future__ import annotations

from pathlib import Path

import pytest

import autograder
from autograder.cli import main


@pytest.fixture
def nowhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.delenv("AUTOGRADER_COURSE", raising=False)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_version_is_that_of_the_package(capsys):
    with pytest.raises(SystemExit) as stopped:
        main(["--version"])
    assert stopped.value.code == 0
    assert capsys.readouterr().out.startswith(f"autograder {autograder.__version__} (Python 3.")


def test_the_doctor_needs_no_course(nowhere: Path, capsys):
    status = main(["doctor"])
    said = capsys.readouterr().out
    assert "There is no course in" in said
    assert "grading: " in said
    assert status in (0, 1)  # what works is the machine's


def test_the_doctor_says_that_a_named_course_does_not_exist(nowhere: Path, capsys):
    assert main(["--course", str(nowhere / "mistyped"), "doctor"]) == 1
    assert "There is no course in" in capsys.readouterr().err


@pytest.mark.parametrize("command", [["check"], ["build"], ["release", "out"]])
def test_any_other_command_says_what_to_do(nowhere: Path, capsys, command: list[str]):
    assert main(command) == 1
    assert "change to the course's folder, or name it with --course" in capsys.readouterr().err
