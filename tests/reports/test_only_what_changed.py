"""Reports of a class that is read a few records at a time; pages only for whom they changed."""

import re
from pathlib import Path

import pytest

from autograder.gradebook import Gradebook
from autograder.gradebook.student_names import names_of
from autograder.reports.class_summary import MOST_NAMED, gather
from autograder.reports.write import Options, write_reports
from tests.classroom import all_marks, fill, graded, make_course

PICTURE = r"\b[td]\d+\b"


@pytest.fixture
def course(tmp_path):
    return make_course(tmp_path / "course")


def pages(out: Path) -> dict[str, int]:
    return {path.stem: path.stat().st_mtime_ns for path in (out / "feedback").iterdir()}


def plain(path: Path) -> str:
    """The text without the numbers by which a process tells its pictures apart."""
    return re.sub(PICTURE, "n", path.read_text(encoding="utf-8"))


def written(course, book: Gradebook, out: Path) -> None:
    write_reports(course, book, Options(out))


def test_a_page_is_written_again_only_if_it_would_say_something_else(course, tmp_path):
    out = tmp_path / "out"
    with Gradebook(tmp_path / "gradebook.db") as book:
        fill(book, *(graded(name, *all_marks()) for name in ("ada", "bob", "cyd", "dan")))
        written(course, book, out)
        before = pages(out)
        assert len(before) == 4
        written(course, book, out)
        assert pages(out) == before
        book.override("bob", "Q2", 1.0, "Said it aloud.")
        (out / "feedback/cyd.html").unlink()
        whole = (out / "feedback/dan.html").read_text()
        (out / "feedback/dan.html").write_text(whole[:-50])
        written(course, book, out)
        now = pages(out)
        assert now["ada"] == before["ada"]
        assert now["bob"] != before["bob"]
        assert "Said it aloud." in (out / "feedback/bob.html").read_text()
        assert "cyd" in now
        assert plain(out / "feedback/dan.html") == re.sub(PICTURE, "n", whole)
        book.set("explanations", "yes")
        written(course, book, out)
        assert not set(pages(out).items()) & set(now.items())


def test_marks_that_come_back_the_same_change_no_page(course, tmp_path):
    out = tmp_path / "out"
    with Gradebook(tmp_path / "gradebook.db") as book:
        fill(book, graded("ada", *all_marks()))
        written(course, book, out)
        before = pages(out)
        fill(book, graded("ada", *all_marks(), seconds=5.0))  # another run
        written(course, book, out)
        assert pages(out) == before
        fill(book, graded("ada", *all_marks((1, 1, 0.5, 1))))
        written(course, book, out)
        assert pages(out) != before


def test_a_class_that_is_not_kept_in_memory_has_the_same_reports(course, tmp_path, monkeypatch):
    several = [
        graded(f"s{n:03}", *all_marks((n % 2, (n % 3) / 2, 1, n % 5 / 4)), seconds=float(n))
        for n in range(40)
    ]
    with Gradebook(tmp_path / "gradebook.db") as book:
        fill(book, *several)
        written(course, book, tmp_path / "kept")
        monkeypatch.setattr("autograder.gradebook.stored_records._KEPT", 5)
        monkeypatch.setattr("autograder.gradebook.stored_records._AT_ONCE", 7)
        written(course, book, tmp_path / "streamed")
        records = book.records()
    files = [path.relative_to(tmp_path / "kept") for path in (tmp_path / "kept").rglob("*.*")]
    assert len(files) == 40 + 5
    for name in files:
        assert plain(tmp_path / "streamed" / name) == plain(tmp_path / "kept" / name)
    assert [record.student for record in records] == [entry.submission.student for entry in several]


def test_a_page_of_a_large_class_names_some_and_counts_all(course, tmp_path):
    with Gradebook(tmp_path / "gradebook.db") as book:
        fill(book, *(graded(f"s{n:04}", *all_marks((0, 0, 0, 0))) for n in range(MOST_NAMED + 30)))
        written(course, book, tmp_path)
        found = gather(course, book.records())
    assert found.needy_count == MOST_NAMED + 30
    assert len(found.needy) == MOST_NAMED
    page = (tmp_path / "class.html").read_text()
    assert f"{MOST_NAMED + 30} students, the lowest {MOST_NAMED}" in page
    assert "All of them are in class_students.csv." in page
    assert len((tmp_path / "class_students.csv").read_text().splitlines()) == MOST_NAMED + 31


def test_names_that_are_gathered_tell_students_apart(tmp_path):
    from dataclasses import replace

    from autograder.gradebook.student_names import Names
    from autograder.intake.origin import Claim, Origin

    def called(key: str, name: str):
        entry = graded(key)
        origin = Origin(claims=(Claim(name=name),))
        return replace(entry, submission=replace(entry.submission, origin=origin))

    with Gradebook(tmp_path / "gradebook.db") as book:
        fill(book, called("a1", "Ada"), called("a2", "Ada"), called("b1", "Bob"), graded("Bob"),
             called("c1", "Cyd"))  # fmt: skip
        records = book.records()
    names = Names()
    for record in records:
        names.add(record)
    names.settle()
    assert {record.student: names[record.student] for record in records} == names_of(records)
