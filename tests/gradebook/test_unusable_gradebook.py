"""What is said of a gradebook that cannot be opened, which stays as it is."""

from __future__ import annotations

import os
import sqlite3
from pathlib import Path

import pytest

from autograder.gradebook import SCHEMA_VERSION, Gradebook, GradebookError
from tests.classroom import fill, graded, mark


def test_a_damaged_file_is_said_in_one_sentence_and_left_as_it_is(path: Path):
    path.parent.mkdir()
    path.write_bytes(b"not a database, " * 500)
    with pytest.raises(GradebookError, match="restore it from a copy"):
        Gradebook(path)
    assert path.read_bytes() == b"not a database, " * 500


def test_damage_inside_a_gradebook_is_found_when_it_is_opened(path: Path):
    with Gradebook(path) as book:
        fill(
            book,
            *(graded(f"student {n}", *[mark(f"Q{q}", 1) for q in range(9)]) for n in range(50)),
        )
    content = bytearray(path.read_bytes())
    assert len(content) > 20_000
    content[8192:16384] = os.urandom(8192)
    path.write_bytes(content)
    with pytest.raises(GradebookError, match="restore it from a copy"):
        Gradebook(path).records()
    assert path.read_bytes() == content


def test_a_gradebook_of_a_newer_version_is_refused_and_left_as_it_is(path: Path):
    Gradebook(path).close()
    db = sqlite3.connect(path)
    db.execute(f"PRAGMA user_version = {SCHEMA_VERSION + 1}")
    db.close()
    before = path.read_bytes()
    with pytest.raises(GradebookError, match="use the version that wrote it"):
        Gradebook(path)
    assert path.read_bytes() == before


def test_another_programs_database_is_refused(path: Path):
    path.parent.mkdir()
    db = sqlite3.connect(path)
    db.execute("CREATE TABLE recipes (name TEXT)")
    db.close()
    with pytest.raises(GradebookError, match="not a gradebook"):
        Gradebook(path)


def test_a_missing_gradebook_is_not_begun_by_looking(path: Path):
    with pytest.raises(GradebookError, match="autograder grade"):
        Gradebook(path, create=False)
    assert not path.parent.exists()


def test_a_folder_that_cannot_be_written_is_said(tmp_path: Path):
    (tmp_path / "grades").write_text("a file where the folder should be")
    with pytest.raises(GradebookError, match="choose another folder"):
        Gradebook(tmp_path / "grades" / "gradebook.db")
