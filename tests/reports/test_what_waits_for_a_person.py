"""What waits for a person is neither earned nor missed, and people of one name are told apart."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from autograder.cli import main
from autograder.course import Course
from autograder.gradebook import Gradebook, Record
from autograder.gradebook.grading_scheme import plain_scheme
from autograder.gradebook.record import Override
from autograder.intake.class_list import ClassList
from autograder.intake.person import Person
from autograder.reports.class_html import class_html
from autograder.reports.exports import write_moodle
from autograder.reports.question_statistics import question_statistics
from autograder.reports.who_needs_help import who_needs_help
from tests.classroom import all_marks, fill, graded, mark
from tests.cli.test_marking_by_hand import with_text


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Course:
    return with_text(tmp_path_factory.mktemp("orchard") / "course")


def record(student: str, credit: float = 1.0, points: float | None = None) -> Record:
    """Work with a text of 3 points, marked by hand if ``points`` are given."""
    text = mark("Q5", 0, 3, status="recorded", understood="Because.")
    work = graded(student, *all_marks((credit,) * 4), text)
    given = {} if points is None else {"Q5": Override(student, "Q5", points, "seen", "2026")}
    return Record(work, 1, 1, given)


def test_a_text_counts_as_tried_once_a_person_has_marked_it(course: Course):
    records = [record(f"waits {number}") for number in range(9)]
    records += [record("all", points=3), record("some", points=1.5), record("none", points=0)]
    text = question_statistics(course, records)[-1]
    assert text.question.id == "Q5"
    assert text.attempted == 3
    assert text.difficulty == pytest.approx(0.5)
    assert text.statuses == {"recorded": 9, "right": 1, "partial": 1, "wrong": 1}
    assert text.troubles == ()
    page = class_html(course, records, None)
    assert "not marked yet</li>" in page
    assert "not marked yet</li>" not in class_html(course, records[9:], None)


def test_nobody_needs_help_for_what_waits_or_does_not_count(course: Course):
    # 10 points are the machine's and 3 a person's: half of those that were marked is enough.
    assert who_needs_help(course, [record("half", 0.5)]) == []
    (needy,) = who_needs_help(course, [record("less", 0.4)])
    assert needy.reasons == ("less than half of the points",)
    assert who_needs_help(course, [record("half", 0.5, points=0)])[0].student == "half"
    dropped = replace(plain_scheme(course), dropped=frozenset({"Q5"}))
    others = replace(record("half", 0.5, points=0), scheme=dropped)
    assert all(needy.chapters == () for needy in who_needs_help(course, [others]))


def test_moodle_tells_students_what_was_dropped_excused_or_extra(course: Course, tmp_path: Path):
    people = (Person("Ada Lovelace", email="a@x.org", submission="ada"),)
    scheme = replace(
        plain_scheme(course),
        dropped=frozenset({"Q1"}),
        bonus=frozenset({"Q2"}),
        excused={"ada": {"Q3": "ill"}},
    )
    records = [replace(record("ada", points=3), scheme=scheme)]
    assert write_moodle(tmp_path / "moodle.csv", course, ClassList(people), records) == []
    row = (tmp_path / "moodle.csv").read_text().splitlines()[1]
    assert '"Q1 dropped, Q2 2/2 (bonus), Q3 excused, Q4 4/4, Q5 3/3"' in row


def test_two_people_of_one_name_are_told_apart_wherever_they_are_listed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    course = with_text(tmp_path / "course")
    out = tmp_path / "grades"
    out.mkdir()
    with Gradebook(out / "gradebook.db") as book:
        fill(book, *(record(student).graded for student in ("ada", "ada2", "boole")))
    people = out / "class.toml"
    people.write_text(
        "".join(
            f'[[student]]\nname = "{name}"\nlogin = "{login}"\n'
            for name, login in (
                ("Ada Lovelace", "ada"),
                ("Ada Lovelace", "ada2"),
                ("George Boole", "boole"),
                ("Kim Lee", "kim"),
                ("Kim Lee", "kim2"),
            )
        )
    )
    (out / "grading.toml").write_text('dropped = ["Q1"]\n')

    def said(*arguments: str) -> str:
        command = ["--course", str(course.root), *arguments, "--out", str(out)]
        assert main(command) == 0
        told = capsys.readouterr()
        return " ".join((told.out + told.err).split())

    for arguments in (("mark", "--list"), ("adjust",), ("export", "--format", "csv")):
        told = said(*arguments)
        assert "Ada Lovelace (ada)" in told
        assert "Ada Lovelace (ada2)" in told
        assert "George Boole (" not in told.replace("George Boole (Q5)", "")
    assert "Kim Lee (kim), Kim Lee (kim2)" in told


def test_a_text_that_was_marked_is_not_said_to_wait(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    course = with_text(tmp_path / "course")
    with Gradebook(tmp_path / "gradebook.db") as book:
        fill(book, record("ada").graded)
        book.override("ada", "Q5", 2, "A leaf is missing.", "tutor")
    main(["--course", str(course.root), "show", "ada", "--out", str(tmp_path)])
    told = " ".join(capsys.readouterr().out.split())
    assert "given by hand (A leaf is missing.)" in told
    assert "the grader said" not in told
