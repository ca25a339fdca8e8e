"""What the command says where there is no course."""

from __future__ import annotations

import argparse
from pathlib import Path

import pytest

import autograder
from autograder.cli import main, parser
from tests.classroom import hand_in, make_course

COMMANDS = next(
    action.choices for action in parser()._actions if isinstance(action, argparse._SubParsersAction)
)


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


def _arguments_of(command: argparse.ArgumentParser) -> list[str]:
    """What the command asks for at least; of several choices the first."""
    needed = []
    for action in command._actions:
        if action.required:
            value = next(iter(action.choices or ["5"]))
            needed += [*action.option_strings[:1], str(value)]
    return needed


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_takes_the_course_before_it_or_after_it(name: str):
    rest = _arguments_of(COMMANDS[name])
    before = parser().parse_args(["--course", "here", name, *rest])
    after = parser().parse_args([name, *rest, "--course", "here"])
    both = parser().parse_args(["--course", "there", name, *rest, "--course", "here"])
    neither = parser().parse_args([name, *rest])
    assert before.course == after.course == both.course == Path("here")
    assert neither.course is None


def test_a_class_is_read_with_the_course_named_at_the_end(nowhere: Path, capsys):
    make_course(nowhere / "course")
    hand_in(nowhere / "work", "ada")
    hand_in(nowhere / "work", "boole")
    assert main(["intake", str(nowhere / "work"), "--course", str(nowhere / "course")]) == 0
    assert "2 handed in" in capsys.readouterr().out
