"""The gradebook keeps what was decided, and never harms a file it cannot read."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

from autograder.errors import UsageError
from autograder.gradebook import Gradebook
from autograder.grading.graded_submission import Graded
from autograder.intake.submissions import Submission
from tests.classroom import fill, graded, hostile_mark, mark


def test_what_is_stored_is_read_again(book: Gradebook):
    entry = graded("ada", mark("Q1", 1), mark("Q2", 0.25), notes=("odd",), seconds=1.5)
    fill(book, entry, seed=7)
    (record,) = book.records()
    assert record.graded == entry
    assert record.seed == 7
    assert record.total == 2 + 0.5


def test_a_second_grading_of_one_question_leaves_the_other_marks(book: Gradebook):
    fill(book, graded("ada", mark("Q1", 0), mark("Q2", 1)))
    run = book.begin_run("new key", 1, "none")
    book.store(graded("ada", mark("Q1", 1)), run, whole=False)
    assert book.record("ada").marks.keys() == {"Q1", "Q2"}
    assert book.record("ada").total == 4


def test_a_whole_grading_drops_the_marks_of_questions_that_are_gone(book: Gradebook):
    fill(book, graded("ada", mark("Q1", 1), mark("Q2", 1)))
    fill(book, graded("ada", mark("Q1", 1)))
    assert book.record("ada").total == 2


def test_work_counts_as_graded_only_when_every_question_is_marked(book: Gradebook):
    run = book.begin_run("version", 1, "none")
    book.store(graded("ada", mark("Q1", 1)), run, whole=False)
    assert book.find("ada", "fada", run, ["Q1"]) is not None
    assert book.find("ada", "fada", run, ["Q1", "Q2"]) is None
    assert book.find("ada", "changed", run, ["Q1"]) is None
    later = book.begin_run("version 2", 1, "none")
    assert book.find("ada", "fada", later, ["Q1"]) is None


def test_an_override_counts_in_place_of_the_mark_and_survives_regrading(book: Gradebook):
    fill(book, graded("ada", mark("Q1", 0), mark("Q2", 1)))
    book.override("ada", "Q1", 1.5, "explained it well")
    assert book.record("ada").total == 1.5 + 2
    fill(book, graded("ada", mark("Q1", 0.5), mark("Q2", 0)))
    record = book.record("ada")
    assert record.total == 1.5
    assert record.overrides["Q1"].reason == "explained it well"


def test_the_latest_override_counts_and_none_withdraws_it(book: Gradebook):
    fill(book, graded("ada", mark("Q1", 0.5)))
    book.override("ada", "Q1", 2, "first")
    book.override("ada", "Q1", 0, "second")
    assert book.record("ada").total == 0
    book.override("ada", "Q1", None, "a mix-up")
    assert book.record("ada").total == 1
    assert [entry.reason for entry in book.overrides("ada")] == ["first", "second", "a mix-up"]


def test_lateness_takes_its_percent_of_the_points_earned(book: Gradebook):
    fill(book, graded("ada", mark("Q1", 1), mark("Q2", 1)))
    book.set_lateness({"ada": ("2026-11-20T10:00:00+00:00", 2, 20.0)})
    record = book.record("ada")
    assert (record.earned, record.deduction, record.total) == (4, 0.8, 3.2)


def test_notes_stay_with_the_student_when_the_work_is_graded_again(book: Gradebook):
    fill(book, graded("ada"))
    book.note("ada", "ill")
    fill(book, graded("ada"))
    assert [note.text for note in book.record("ada").notes] == ["ill"]


def test_a_student_is_found_in_any_case_and_near_names_are_offered(book: Gradebook):
    fill(book, graded("Ada Lovelace"))
    assert book.record("ada lovelace").student == "Ada Lovelace"
    with pytest.raises(UsageError, match="Ada Lovelace"):
        book.record("love")


def test_others_read_while_a_grader_writes(book: Gradebook, path: Path):
    fill(book, graded("ada", mark("Q1", 1)))
    with book._transaction() as db:
        db.execute("DELETE FROM mark")
        with Gradebook(path, create=False) as reader:
            assert reader.record("ada").total == 2
    assert book.record("ada").total == 0


def test_a_failed_write_leaves_everything_as_it_was(book: Gradebook):
    fill(book, graded("ada", mark("Q1", 1)))
    run = book.last_run()
    broken = Graded(
        Submission("ada", Path("x")),
        "graded",
        "new",
        (mark("Q1", 0, understood=b"no JSON"),),  # type: ignore[arg-type]
    )
    with pytest.raises(TypeError):
        book.store(broken, run)
    assert book.record("ada").total == 2
    assert book.record("ada").graded.fingerprint == "fada"


def test_the_first_version_is_brought_up_to_date_with_its_marks(path: Path, monkeypatch):
    from autograder.gradebook import schema

    with monkeypatch.context() as old:
        old.setattr(schema, "_STEPS", schema._STEPS[:1])
        old.setattr(schema, "SCHEMA_VERSION", 1)
        db = schema.connect(path, create=True)
        db.execute("INSERT INTO run VALUES (1, 'v', 3, 'none', '2026-11-01T00:00:00+00:00')")
        db.execute("INSERT INTO submission VALUES ('ada', '/ada.zip', 'f', 'graded', '[]', 1)")
        db.close()
    with Gradebook(path) as book:
        assert book.record("ada").seed == 3
        book.override("ada", "Q1", 1, "now possible")
        assert book.record("ada").total == 1


def test_names_that_are_no_utf8_can_be_kept_and_found_again(book: Gradebook, tmp_path: Path):
    odd = tmp_path / os.fsdecode(b"caf\xe9.zip")
    run = book.begin_run("v", 1, "none")
    book.store(Graded(Submission("caf?", odd), "graded", "f", ()), run)
    assert book.record("caf?").graded.submission.path == odd


def test_each_submission_has_the_isolation_in_which_it_was_graded(book: Gradebook, tmp_path: Path):
    run = book.begin_run("v", 1, "bubblewrap")
    for student, isolation in (("ada", "Landlock"), ("boole", "bubblewrap"), ("curie", "")):
        submission = Submission(student, tmp_path / f"{student}.zip")
        marks = (mark("Q1", 1),)
        book.store(Graded(submission, "graded", "f", marks, isolation=isolation), run)
    told = {record.student: record.isolation for record in book.records()}
    # Without its own, as after an older version, it is the run's.
    assert told == {"ada": "Landlock", "boole": "bubblewrap", "curie": "bubblewrap"}
    found = book.find("ada", "f", run)
    assert found is not None
    assert found.isolation == "Landlock"


def test_any_text_of_a_student_can_be_kept(book: Gradebook):
    text = "\ud800 \x00 \x1b[31m '; DROP TABLE mark; --"
    fill(book, graded("ada", hostile_mark("Q1", text)))
    assert book.record("ada").marks["Q1"].feedback == text


def test_a_copy_taken_while_the_book_is_open_is_complete(
    book: Gradebook, path: Path, tmp_path: Path
):
    fill(book, graded("ada", mark("Q1", 1)))
    book.close()
    shutil.copy(path, tmp_path / "copy.db")
    with Gradebook(tmp_path / "copy.db", create=False) as copy:
        assert copy.record("ada").total == 2


def test_a_gradebook_of_an_older_version_keeps_everything_as_it_is_migrated(tmp_path: Path):
    import sqlite3

    from autograder.gradebook.schema import _STEPS

    path = tmp_path / "gradebook.db"
    db = sqlite3.connect(path)
    for step in _STEPS[:3]:
        db.executescript(step)
    db.execute("PRAGMA user_version = 3")
    db.execute("INSERT INTO run VALUES (1, 'v', 5, 'bwrap', '2026-01-01', NULL, 0)")
    db.execute("INSERT INTO submission VALUES ('ada','/a','f','graded','[]',1,0,NULL,0,0,'{}')")
    db.execute("INSERT INTO override VALUES (1, 'ada', 'Q1', 1.5, 'oral', '2026-01-02')")
    db.execute("INSERT INTO note VALUES (1, 'ada', 'was ill', '2026-01-02')")
    db.commit()
    db.close()
    with Gradebook(path) as book:
        record = book.record("ada")
    assert record.overrides["Q1"].points == 1.5
    assert (record.overrides["Q1"].author, record.overrides["Q1"].levels) == ("", {})
    assert record.notes[0].text == "was ill"
