"""A long list lies on disk and reads like any other."""

import pickle

import pytest

from autograder.intake.origin import Origin, Piece
from autograder.intake.shelf import Shelf


@pytest.mark.parametrize("count", [0, 1, 511, 512, 1023, 1024, 1025, 5000])
def test_a_shelf_reads_like_a_list(count):
    items = [f"student {n}" for n in range(count)]
    shelf = Shelf(items)
    assert len(shelf) == count
    assert list(shelf) == items == list(shelf)
    assert shelf == items
    assert shelf[:3] == items[:3]
    assert shelf[-2:] == items[-2:]
    if count:
        assert (shelf[0], shelf[-1]) == (items[0], items[-1])
    with pytest.raises(IndexError):
        shelf[count]


def test_shelves_that_grow_in_turns_do_not_mix():
    one, other = Shelf(), Shelf()
    for n in range(3000):
        one.append(n)
        other += [-n, -n]
    assert list(one) == list(range(3000))
    assert len(other) == 6000
    assert other[2 * 2999] == -2999


def test_of_many_only_the_last_are_in_memory(tmp_path):
    shelf = Shelf(Origin(prefix=str(n), pieces=(Piece(tmp_path / str(n)),)) for n in range(2000))
    assert len(shelf._end) < 1024
    assert shelf[1].pieces[0].path == tmp_path / "1"


def test_a_shelf_makes_nothing_but_what_belongs_on_it():
    class Elsewhere:
        def __reduce__(self):
            return print, ("made",)

    shelf = Shelf([Elsewhere()] * 1024)
    with pytest.raises(pickle.UnpicklingError, match=r"builtins\.print"):
        shelf[0]
