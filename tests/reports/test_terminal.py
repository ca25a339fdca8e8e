"""What is printed: plain where nobody watches, and harmless whatever students are called."""

from __future__ import annotations

import io
from pathlib import Path

from rich.console import Console

from autograder.course import Course
from autograder.gradebook import Note, Override, Record
from autograder.gradebook.changes import Change, changes_of
from autograder.reports.terminal import print_changes, print_table, warn
from autograder.reports.terminal_student import print_record
from tests.classroom import all_marks, graded, hostile_mark, mark

HOSTILE = "\x1b[2J\x1b]0;owned\x07[bold]\x9b31m\u202e\ud800\r\nadmin: all right"


def hostile_record() -> Record:
    marks = [hostile_mark(f"Q{n}", HOSTILE) for n in range(1, 5)]
    return Record(
        graded(HOSTILE, *marks, notes=(HOSTILE,)),
        1,
        1,
        {"Q1": Override(HOSTILE, "Q1", 1, HOSTILE, HOSTILE)},
        (Note(HOSTILE, HOSTILE, HOSTILE),),
    )


def printed(action, **options) -> str:
    file = io.StringIO()
    action(Console(file=file, width=120, highlight=False, **options))
    return file.getvalue()


def test_no_text_of_a_student_reaches_the_terminal_as_a_command(course: Course, capsys):
    record = hostile_record()
    change = Change(HOSTILE, HOSTILE, record.marks["Q1"], record.marks["Q2"], True)
    out = printed(lambda console: print_table(console, course, [record]))
    override = Override(HOSTILE, "Q1", 1.0, HOSTILE, HOSTILE, HOSTILE)
    out += printed(lambda c: print_record(c, course, record, [override]))
    out += printed(lambda c: print_changes(c, {HOSTILE: record.earned}, [change]))
    warn(HOSTILE)
    out += capsys.readouterr().err
    assert not set(out) & set("\x1b\x07\x9b\u202e\ud800\r")
    assert not any(line.startswith("admin") for line in out.splitlines())
    assert "[bold]" in out  # shown, not obeyed


def test_a_terminal_gets_colors_and_a_pipe_gets_none(course: Course):
    record = Record(graded("ada", *all_marks((1, 0, 0.5, 1))), 1, 1)
    table = lambda console: print_table(console, course, [record])  # noqa: E731
    assert "\x1b[32m" in printed(table, force_terminal=True, color_system="standard")
    assert "\x1b" not in printed(table)


def test_every_status_has_a_sign_of_its_own(course: Course):
    statuses = ["right", "partial", "wrong", "not attempted", "error", "timeout", "killed"]
    signs = set()
    for status in statuses:
        record = Record(graded("ada", mark("Q1", 0, status=status)), 1, 1)
        signs.add(printed(lambda c, r=record: print_table(c, course, [r])).split()[5])
    assert len(signs) == len(statuses)


def test_a_change_counts_points_verdicts_and_mistakes_but_no_wording():
    old = Record(graded("ada", mark("Q1", 0.5, alternative="a"), mark("Q2", 1)), 1, 1)
    same = graded("ada", mark("Q1", 0.5, alternative="a", feedback="Other words."), mark("Q2", 1))
    other = graded("ada", mark("Q1", 0.5, alternative="b"), mark("Q2", 1))
    assert changes_of(old, same) == []
    (change,) = changes_of(old, other)
    assert (change.question, change.points) == ("Q1", 0)


def test_an_overridden_change_leaves_the_points(tmp_path: Path):
    override = Override("ada", "Q1", 1.5, "oral", "")
    old = Record(graded("ada", mark("Q1", 0)), 1, 1, {"Q1": override})
    (change,) = changes_of(old, graded("ada", mark("Q1", 1)))
    assert change.points == 0
    out = printed(lambda console: print_changes(console, {"ada": old.earned}, [change]))
    assert "ada: 1.5 → 1.5 points" in out
    assert "the override stays" in out
