"""Wrong orders are named by what was done to a right one."""

import itertools

import pytest

from autograder.kinds.order.diagnosis import diagnose_order
from autograder.kinds.order.marking import transitive_closure

RIGHT = tuple("abcdefgh")
AFTER = transitive_closure(itertools.pairwise(RIGHT))
TEXTS = {card: card.upper() for card in RIGHT}


@pytest.mark.parametrize(
    ("order", "name"),
    [
        ("bcdefgha", "one card misplaced"),
        ("abcdhefg", "one card misplaced"),
        ("afcdebgh", "two cards exchanged"),
        ("hgfedcba", "everything reversed"),
        ("abfedcgh", "reversed within a stage"),
        ("efghabcd", "a stage moved"),
        ("acdefgbh", "one card misplaced"),
        ("abdefgch", "one card misplaced"),
        ("cdefghab", "a stage moved"),
        ("ghcdefab", "two stages exchanged"),
    ],
)
def test_an_order_is_named_by_what_was_done_to_a_right_one(order, name):
    found = diagnose_order(tuple(order), RIGHT, AFTER, TEXTS)
    assert found is not None
    assert found.name == name
    assert found.sentence.startswith("It looks as if ")


@pytest.mark.parametrize("order", ["badcfehg", "hbdfacge", "cadbgehf"])
def test_an_order_without_such_a_change_has_no_name(order):
    assert diagnose_order(tuple(order), RIGHT, AFTER, TEXTS) is None


def test_no_right_order_is_named():
    after = transitive_closure([("a", "b"), ("b", "c"), ("d", "c")])
    right = ("a", "b", "d", "c")
    for order in (right, ("d", "a", "b", "c"), ("a", "d", "b", "c")):
        assert diagnose_order(order, right, after, TEXTS) is None


def test_a_card_that_is_free_may_stand_anywhere_beside_the_change():
    after = transitive_closure([*itertools.pairwise("abcdefg")])  # h is free
    found = diagnose_order(tuple("hdefgabc"), RIGHT, after, TEXTS)
    assert found is not None
    assert found.name == "a stage moved"
