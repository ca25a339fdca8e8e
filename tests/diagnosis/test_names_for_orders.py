"""Wrong orders are named by what was done to a right one."""

import itertools

import pytest

from autograder.kinds.order.diagnosis import diagnose_order
from autograder.kinds.order.marking import transitive_closure

RIGHT = tuple("abcdefgh")
AFTER = transitive_closure(itertools.pairwise(RIGHT))
TEXTS = {card: card.upper() for card in RIGHT}


LATE = "a whole stage stands too late, the steps from {}; within it the order is right"
EARLY = "a whole stage stands too early, the steps from {}; within it the order is right"


@pytest.mark.parametrize(
    ("order", "name", "sentence"),
    [
        ("bcdefgha", "one card misplaced", "only “A” is out of place: it stands too late"),
        ("abcdhefg", "one card misplaced", "only “H” is out of place: it stands too early"),
        ("acdefgbh", "one card misplaced", "only “B” is out of place: it stands too late"),
        ("abdefgch", "one card misplaced", "only “C” is out of place: it stands too late"),
        ("afcdebgh", "two cards exchanged", "“B” and “F” have changed places"),
        ("adcbefgh", "two cards exchanged", "“B” and “D” have changed places"),
        ("hgfedcba", "everything reversed",
         "the whole order is reversed: the first step stands last"),
        ("abfedcgh", "reversed within a stage",
         "one stage is reversed, the steps from “C” to “F”"),
        ("efghabcd", "a stage moved", LATE.format("“A” to “D”")),
        ("cdefghab", "a stage moved", LATE.format("“A” to “B”")),
        ("ghabcdef", "a stage moved", EARLY.format("“G” to “H”")),
        ("ghcdefab", "two stages exchanged",
         "two stages have changed places, the steps from “A” to “B” and those from “G” to “H”"),
        ("efghdabc", "two stages exchanged",
         "two stages have changed places, the steps from “A” to “C” and those from “E” to “H”"),
        ("ghfabcde", "two stages exchanged",
         "two stages have changed places, the steps from “A” to “E” and those from “G” to “H”"),
    ],
)  # fmt: skip
def test_an_order_is_named_by_what_was_done_to_a_right_one(order, name, sentence):
    found = diagnose_order(tuple(order), RIGHT, AFTER, TEXTS)
    assert found is not None
    assert (found.name, found.sentence) == (name, f"It looks as if {sentence}.")


@pytest.mark.parametrize("order", ["badcfehg", "hbdfacge", "cadbgehf", "ghbcdefa"])
def test_an_order_without_such_a_change_has_no_name(order):
    assert diagnose_order(tuple(order), RIGHT, AFTER, TEXTS) is None


def test_no_right_order_is_named():
    after = transitive_closure([("a", "b"), ("b", "c"), ("d", "c")])
    right = ("a", "b", "d", "c")
    for order in (right, ("d", "a", "b", "c"), ("a", "d", "b", "c")):
        assert diagnose_order(order, right, after, TEXTS) is None


@pytest.mark.parametrize(
    ("free", "order", "name"),
    [
        ("h", "hdefgabc", "a stage moved"),
        ("h", "hbacdefg", "one card misplaced"),
        ("h", "bacdhefg", "one card misplaced"),
        ("h", "gfedcbah", "everything reversed"),
        ("a", "cbdefgha", "one card misplaced"),
    ],
)
def test_a_card_that_is_free_may_stand_anywhere_beside_the_change(free, order, name):
    after = transitive_closure(itertools.pairwise(card for card in RIGHT if card != free))
    found = diagnose_order(tuple(order), RIGHT, after, TEXTS)
    assert found is not None
    assert found.name == name
