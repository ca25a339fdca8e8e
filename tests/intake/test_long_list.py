"""A long list lies on disk and reads like any other."""

import os
from datetime import datetime
from zoneinfo import ZoneInfo

import pytest

from autograder.gradebook.changes import Change
from autograder.intake.long_list import LongList
from autograder.intake.match_people import Match
from autograder.intake.origin import Claim, Origin, Piece
from autograder.intake.person import Person
from autograder.intake.submissions import Submission
from autograder.intake.summary import Row
from tests.classroom import mark


@pytest.mark.parametrize("count", [0, 1, 511, 512, 1023, 1024, 1025, 5000])
def test_a_long_list_reads_like_a_list(count):
    items = [f"student {n}" for n in range(count)]
    long_list = LongList(str, items)
    assert len(long_list) == count
    assert list(long_list) == items == list(long_list)
    assert long_list == items
    assert long_list[:3] == items[:3]
    assert long_list[-2:] == items[-2:]
    if count:
        assert (long_list[0], long_list[-1]) == (items[0], items[-1])
    with pytest.raises(IndexError):
        long_list[count]


def test_shelves_that_grow_in_turns_do_not_mix():
    one, other = LongList(int), LongList(int)
    for n in range(3000):
        one.append(n)
        other += [-n, -n]
    assert list(one) == list(range(3000))
    assert len(other) == 6000
    assert other[2 * 2999] == -2999


def test_of_many_only_the_last_are_in_memory(tmp_path):
    long_list = LongList(Origin, (Origin(pieces=(Piece(tmp_path / str(n)),)) for n in range(2000)))
    assert len(long_list._end) < 1024
    assert long_list[1].pieces[0].path == tmp_path / "1"


def test_what_comes_back_is_what_was_put_in(tmp_path):
    """Also names that are no text, and times of any zone."""
    name = os.fsdecode(b"m\xfcller \xf0\x9f\x8d\x8e.zip")
    when = datetime(2026, 11, 20, 23, 59, 30, 5, tzinfo=ZoneInfo("Europe/Zurich"))
    origin = Origin("moodle", name, (Claim(name, id="7"),), "2", when, "layout", True,
                    (Piece(tmp_path / name, ("a.zip", "b/")),))  # fmt: skip
    person = Person("Ada", email="ada@example.org", handed_in=when)
    row = Row(Submission(name, tmp_path / name, ("odd",), origin), Match((person,)), 2, 10.0)
    long_list = LongList(Row, [row] * 1500)
    assert long_list[0] is not row
    assert set(long_list) == {row}
    change = Change("ada", "Q1", mark("Q1", 0.5, shown=[1, [2.5]]), mark("Q1", 1), False)
    assert LongList(Change, [change] * 1024)[0] == change
