"""A file of the course that cannot be read is named in one sentence."""

import os
from pathlib import Path

import pytest

from autograder.cli import main
from tests.classroom import hand_in, make_course

FILES = {
    "key": "solutions/answers/orchard.toml",
    "questions": "notebooks/questions/orchard.toml",
    "settings": "pyproject.toml",
    "reference": "orchard_reference.py",
}


@pytest.fixture
def school(tmp_path: Path) -> Path:
    make_course(tmp_path / "course")
    hand_in(tmp_path / "work", "ada")
    return tmp_path


def check_refused(school: Path, capsys: pytest.CaptureFixture[str], name: str) -> None:
    grade = ["grade", str(school / "work"), "--out", str(school / "out")]
    assert main(["--course", str(school / "course"), *grade]) == 1
    said = capsys.readouterr().err.lstrip("\n")  # an early Rich ends its bar with a line of its own
    assert said.startswith("autograder: ")
    assert said.count("\n") == 1
    assert Path(name).stem in said


@pytest.mark.parametrize("name", [FILES["key"], FILES["questions"], FILES["settings"]])
def test_a_folder_in_its_place(school, capsys, name):
    (school / "course" / name).unlink()
    (school / "course" / name).mkdir()
    check_refused(school, capsys, name)


@pytest.mark.parametrize("name", FILES.values())
def test_bytes_that_are_no_text(school, capsys, name):
    (school / "course" / name).write_bytes(b"\xff\xfe\x00")
    check_refused(school, capsys, name)


@pytest.mark.skipif(os.geteuid() == 0, reason="root may read everything")
@pytest.mark.parametrize("name", FILES.values())
def test_a_file_that_is_closed_to_this_user(school, capsys, name):
    (school / "course" / name).chmod(0)
    check_refused(school, capsys, name)
