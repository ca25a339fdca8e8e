"""A gradebook whose entries are broken, or a link in its place, is told in one sentence."""

import os
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

from autograder.cli import main
from autograder.gradebook import Gradebook
from tests.classroom import all_marks, graded, hand_in, make_course

BROKEN = [
    "UPDATE mark SET mark = '{'",
    "UPDATE mark SET mark = '{}'",
    "UPDATE mark SET mark = '[1]'",
    "UPDATE mark SET mark = json_set(mark, '$.status', 'great')",
    "UPDATE mark SET mark = json_set(mark, '$.credit', 'x')",
    "UPDATE mark SET mark = json_set(mark, '$.credit', 7)",
    "UPDATE mark SET mark = json_set(mark, '$.parts', 5)",
    "UPDATE mark SET mark = json_set(mark, '$.feedback', 5)",
    "UPDATE submission SET notes = 'x'",
    "UPDATE submission SET notes = '5'",
    "UPDATE submission SET origin = 'x'",
    "UPDATE submission SET origin = '[]'",
    "UPDATE submission SET origin = json_set(origin, '$.handed_in', 'noon')",
    "PRAGMA user_version = 1",
    "PRAGMA user_version = 3",
    "DROP TABLE mark",
]


@pytest.fixture(scope="module")
def root(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("orchard")
    make_course(folder / "course")
    return folder


def fill(out: Path) -> None:
    with Gradebook(out / "gradebook.db") as book:
        run = book.begin_run("1", 1)
        book.store(graded("ada", *all_marks()), run)


@pytest.mark.parametrize("change", BROKEN)
@pytest.mark.parametrize("command", [["show", "ada"], ["export", "--format", "csv"]])
def test_an_entry_that_cannot_be_read_is_told_and_nothing_is_lost(
    root, tmp_path, capsys, change, command
):
    fill(tmp_path)
    with closing(sqlite3.connect(tmp_path / "gradebook.db")) as db:
        db.executescript(change)
    before = (tmp_path / "gradebook.db").read_bytes()
    arguments = ["--course", str(root / "course"), *command, "--out", str(tmp_path)]
    assert main(arguments) == 1
    said = capsys.readouterr().err
    assert said.startswith("autograder: ")
    assert said.count("\n") == 1
    assert "restore it from a copy" in said
    assert (tmp_path / "gradebook.db").read_bytes() == before


def test_what_a_newer_version_wrote_beside_a_mark_is_left_out(tmp_path):
    fill(tmp_path)
    with closing(sqlite3.connect(tmp_path / "gradebook.db")) as db:
        db.executescript("UPDATE mark SET mark = json_set(mark, '$.news', 'yes')")
    with Gradebook(tmp_path / "gradebook.db") as book:
        assert len(book.record("ada").marks) == 4


@pytest.mark.parametrize(
    "name", ["gradebook.db", "gradebook.db-wal", "gradebook.at-work", "feedback"]
)
def test_nothing_is_written_through_a_link_in_the_output_folder(root, tmp_path, capsys, name):
    hand_in(tmp_path / "work", "ada")
    victim = tmp_path / "victim"
    if name == "feedback":
        victim.mkdir()
    else:
        victim.write_text("precious")
    out = tmp_path / "out"
    out.mkdir()
    (out / name).symlink_to(victim)
    grade = ["grade", str(tmp_path / "work"), "--out", str(out)]
    assert main(["--course", str(root / "course"), *grade]) == 1
    assert "is a link" in capsys.readouterr().err
    assert (list(victim.iterdir()) if name == "feedback" else victim.read_text()) in (
        [],
        "precious",
    )


def test_links_in_place_of_reports_are_replaced(root, tmp_path):
    hand_in(tmp_path / "work", "ada")
    out = tmp_path / "out"
    (out / "feedback").mkdir(parents=True)
    victim = tmp_path / "victim"
    victim.write_text("precious")
    names = ("grades.csv", "class.html", "feedback/ada.html")
    for name in names:
        (out / name).symlink_to(victim)
        (out / f"{name}.tmp").symlink_to(victim)
    grade = ["grade", str(tmp_path / "work"), "--out", str(out)]
    assert main(["--course", str(root / "course"), *grade]) == 0
    assert victim.read_text() == "precious"
    assert not any((out / name).is_symlink() for name in names)


@pytest.mark.skipif(os.name == "nt", reason="rights are access lists there")
def test_a_folder_that_grading_makes_is_its_owners_alone(root, tmp_path):
    hand_in(tmp_path / "work", "ada")
    out = tmp_path / "out"
    before = os.umask(0o022)
    try:
        grade = ["grade", str(tmp_path / "work"), "--out", str(out)]
        assert main(["--course", str(root / "course"), *grade]) == 0
    finally:
        os.umask(before)
    assert oct(out.stat().st_mode & 0o777) == "0o700"
