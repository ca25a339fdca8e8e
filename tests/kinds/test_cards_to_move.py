"""Which cards of an order question are out of place."""

from __future__ import annotations

from itertools import combinations

from hypothesis import given
from hypothesis import strategies as st

from autograder.kinds.order.marking import cards_to_move, transitive_closure

CARDS = tuple("abcdefg")


@given(
    order=st.permutations(CARDS),
    pairs=st.sets(st.sampled_from(list(combinations(CARDS, 2))), max_size=12),
)
def test_they_are_as_few_as_trying_every_set_finds_and_lifting_them_leaves_no_conflict(
    order: list[str], pairs: set[tuple[str, str]]
):
    after = transitive_closure(pairs)

    def holds_no_conflict(kept: list[str]) -> bool:
        return not any(first in after.get(second, ()) for first, second in combinations(kept, 2))

    def without(lifted: set[str]) -> list[str]:
        return [card for card in order if card not in lifted]

    astray = cards_to_move(order, after)
    assert holds_no_conflict(without(astray))
    fewest = next(
        size
        for size in range(len(CARDS) + 1)
        if any(holds_no_conflict(without(set(lifted))) for lifted in combinations(CARDS, size))
    )
    assert len(astray) == fewest


def test_one_card_carried_to_the_end_is_the_one_out_of_place():
    after = transitive_closure([("a", "b"), ("b", "c"), ("c", "d")])
    assert cards_to_move(["b", "c", "d", "a"], after) == {"a"}
