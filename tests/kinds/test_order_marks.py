"""What the mark of an order says, word by word, and which cards it calls out of place."""

from __future__ import annotations

from itertools import combinations, pairwise, permutations

import pytest
from test_order import question_of

from autograder.kinds.order.answer import OrderAlternative, OrderAnswer
from autograder.kinds.order.marking import (
    cards_to_move,
    fewest_moves,
    is_right,
    mark_order,
    transitive_closure,
)
from autograder.marking import Mark

CARDS = tuple("abcdef")
ROW = tuple(pairwise(CARDS))


def answer_of(
    before: tuple[tuple[str, str], ...] = ROW,
    mistakes: tuple[str, ...] = (),
    same: tuple[str, ...] = (),
    explanation: str = "",
) -> OrderAnswer:
    """A mistake is written as two cards: the first of them stands too early."""
    return OrderAnswer(
        id="Q9", explanation=explanation, code="", order=CARDS, before=before,
        interchangeable=tuple(map(tuple, same)),
        alternatives=tuple(
            OrderAlternative(name=pair, credit=0.0, feedback=f"On {pair}.", first=pair[0],
                             second=pair[1])
            for pair in mistakes
        ),
    )  # fmt: skip


def mark(order: str, answer: OrderAnswer | None = None) -> Mark:
    return mark_order(question_of(CARDS), answer or answer_of(), list(order))


def test_whether_an_order_is_right_is_a_plain_truth_value():
    answer = answer_of(same=("af", "bc"))
    for order in ("abcdef", "fbcdea", "acbdef", "fcbdea"):
        assert is_right(order, answer) is True
    for order in ("bacdef", "abcdfe", "fedcba"):
        assert is_right(order, answer) is False


def test_what_cannot_be_marked_says_why():
    unread = mark("abcde")
    assert (unread.status, unread.feedback, unread.max_points) == (
        "unreadable", "The stored response does not name every card once.", 10.0,
    )  # fmt: skip
    dealt = mark("fedcba")
    assert (dealt.status, dealt.feedback) == (
        "not attempted", "The cards are still in the order in which they were dealt.",
    )  # fmt: skip


def test_the_explanation_is_the_order_and_what_the_author_adds():
    listed = "1. text a\n2. text b\n3. text c\n4. text d\n5. text e\n6. text f"
    for order in ("abcdef", "bacdef"):
        assert mark(order).explanation == listed
        assert mark(order, answer_of(explanation="So.")).explanation == f"{listed}\n\nSo."


def test_a_right_order_earns_everything():
    right = mark("abcdef")
    assert (right.status, right.credit, right.points, right.alternative) == (
        "right", 1.0, 10.0, "right",
    )  # fmt: skip
    assert right.feedback == "Every step comes after the steps it needs."
    assert right.understood == "text a › text b › text c › text d › text e › text f"


ONE, TWO = "1 card would have to move.", "2 cards would have to move."
EARLY = "It looks as if only “text c” is out of place: it stands too early."
STAGE = (
    "It looks as if a whole stage stands too late, the steps from “text a” to “text b”; within it "
    "the order is right."
)
ASK = "Ask which of the two needs the other's result."


@pytest.mark.parametrize(
    ("order", "mistakes", "name", "feedback"),
    [
        # A diagnosis where the author says nothing, with the first two cards in conflict.
        ("cabdef", (), "one card misplaced",
         f"{ONE} {EARLY} “text c” stands before “text a”. {ASK}"),
        # What the author says explains that one card is astray.
        ("cabdef", ("ca",), "ca", f"{ONE} On ca."),
        ("cabdef", ("da", "cb", "ca"), "cb", f"{ONE} On cb."),
        ("cabdef", ("da", "db"), "one card misplaced",
         f"{ONE} {EARLY} “text c” stands before “text a”. {ASK}"),
        # It does not explain that more are.
        ("cdabef", ("ca",), "a stage moved", f"{TWO} {STAGE} On ca."),
        ("cdabef", (), "a stage moved", f"{TWO} {STAGE} “text c” stands before “text a”. {ASK}"),
        # Where nothing else explains it, it is all that can be said.
        ("bafced", ("ba",), "ba", "3 cards would have to move. On ba."),
        ("bafced", (), None,
         f"3 cards would have to move. “text b” stands before “text a”. {ASK}"),
        ("afbced", (), None, f"{TWO} “text f” stands before “text b”. {ASK}"),
    ],
)  # fmt: skip
def test_a_wrong_order_is_told_what_explains_it(order, mistakes, name, feedback):
    verdict = mark(order, answer_of(mistakes=mistakes))
    assert (verdict.alternative, verdict.feedback) == (name, feedback)


@pytest.mark.parametrize(
    ("order", "moves"), [("abcdef", 0), ("bacdef", 1), ("cdabef", 2), ("bafced", 3), ("defcba", 3)]
)
def test_each_card_to_move_costs_two_shares_of_all(order, moves):
    verdict = mark(order)
    assert verdict.credit == pytest.approx(1 - moves / 3)
    assert sum(not part.right for part in verdict.parts) == moves
    assert verdict.max_points == 10.0


def test_more_cards_to_move_than_half_earn_nothing():
    verdict = mark("feadcb", answer_of())
    assert sum(not part.right for part in verdict.parts) == 4
    assert (verdict.status, verdict.credit) == ("wrong", 0.0)


def test_a_card_out_of_place_is_told_between_which_it_belongs():
    fork = (("a", "c"), ("b", "c"), ("c", "d"), ("c", "e"))
    verdict = mark("cabdef", answer_of(fork))
    told = [(part.label, part.right, part.feedback, part.explanation) for part in verdict.parts]
    assert told == [
        ("Card 1", False, "",
         "“text c” comes after “text a” and “text b” and before “text d” and “text e”."),
        *((f"Card {n}", True, "", "") for n in range(2, 7)),
    ]  # fmt: skip
    last = mark("abecdf", answer_of(fork)).parts[2]
    assert (last.label, last.explanation) == ("Card 3", "“text e” comes after “text c”.")
    first = mark("bcdeaf", answer_of(fork)).parts[4]
    assert (first.label, first.explanation) == ("Card 5", "“text a” comes before “text c”.")


def test_cards_with_one_text_are_read_in_the_way_that_is_best_for_the_student():
    answer = answer_of(same=("bd",))
    right = mark("adcbef", answer)
    assert (right.status, right.alternative) == ("right", "right")
    assert right.understood == "text a › text b › text c › text d › text e › text f"
    near = mark("dacbef", answer)
    assert near.understood == "text b › text a › text c › text d › text e › text f"
    assert (near.alternative, near.credit) == ("one card misplaced", pytest.approx(2 / 3))


@pytest.mark.parametrize(
    ("order", "name"),
    [
        ("abfecd", "a stage moved"),  # read as aefbcd
        ("adcebf", "two cards exchanged"),  # read as adcbef
        ("cdabef", "a stage moved"),  # as it stands; cdaebf has no name
    ],
)
def test_a_name_is_looked_for_in_each_reading(order, name):
    verdict = mark(order, answer_of(same=("be",)))
    assert (verdict.alternative, verdict.feedback[: len(TWO)]) == (name, TWO)


def test_the_closure_holds_all_that_follow_and_ends_for_a_circle():
    assert transitive_closure([]) == {}
    assert transitive_closure([("a", "b"), ("a", "c"), ("c", "d"), ("b", "d")]) == {
        "a": {"b", "c", "d"}, "b": {"d"}, "c": {"d"},
    }  # fmt: skip
    assert transitive_closure([("a", "b"), ("b", "a")]) == {"a": {"a", "b"}, "b": {"a", "b"}}


GRAPHS = [
    ROW[:4],
    (("a", "b"), ("c", "d"), ("b", "e")),
    (("a", "d"), ("b", "d"), ("c", "d"), ("d", "e")),
    (("a", "b"), ("a", "c"), ("a", "d"), ("c", "e")),
    (),
]


@pytest.mark.parametrize("before", GRAPHS)
def test_the_cards_to_move_are_a_smallest_set_in_every_order_of_five(before):
    after = transitive_closure(before)

    def conflict(kept: list[str]) -> bool:
        return any(first in after.get(second, ()) for first, second in combinations(kept, 2))

    for order in permutations("abcde"):
        astray = cards_to_move(order, after)
        assert not conflict([card for card in order if card not in astray])
        assert len(astray) == fewest_moves(order, after)
        fewer = combinations(order, max(len(astray) - 1, 0))
        assert not astray or all(conflict([c for c in order if c not in few]) for few in fewer)
