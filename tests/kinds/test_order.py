"""Order questions: right is what respects the graph, and credit falls with the cards to move."""

import itertools
import random

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from autograder.kinds.order.answer import OrderAnswer
from autograder.kinds.order.marking import (
    fewest_moves,
    is_right,
    mark_order,
    transitive_closure,
)
from autograder.kinds.order.question import Card, Order
from autograder.marking.marker import Marker

Graph = list[tuple[str, str]]


def respects(order: tuple[str, ...], before: Graph) -> bool:
    return all(order.index(first) < order.index(second) for first, second in before)


def fewest_moves_by_trying(order: tuple[str, ...], before: Graph) -> int:
    """The largest set of cards that may stay, found by looking at every right order."""
    best = len(order)
    for target in itertools.permutations(order):
        if respects(target, before):
            position = {card: index for index, card in enumerate(target)}
            best = min(best, len(order) - _longest_rise([position[card] for card in order]))
    return best


def _longest_rise(numbers: list[int]) -> int:
    """The length of the longest increasing subsequence."""
    lengths: list[int] = []
    for at, number in enumerate(numbers):
        shorter = [lengths[i] for i in range(at) if numbers[i] < number]
        lengths.append(1 + max(shorter, default=0))
    return max(lengths)


def question_of(cards: tuple[str, ...]) -> Order:
    """Dealt in reverse."""
    return Order(
        id="Q9", chapter="c", title="t", prompt="p", points=10.0, hints=("h",),
        cards=tuple(Card(card, f"text {card}") for card in reversed(cards)),
    )  # fmt: skip


def answer_of(cards: tuple[str, ...], before: Graph, same: tuple[str, ...] = ()) -> OrderAnswer:
    return OrderAnswer(
        id="Q9", explanation="", code="", alternatives=(), order=cards, before=tuple(before),
        interchangeable=(same,) if same else (),
    )  # fmt: skip


@st.composite
def graphs(draw: st.DrawFn, most: int = 6) -> tuple[tuple[str, ...], Graph]:
    """Cards in a right order, and a graph that it respects."""
    cards = tuple("abcdefgh"[: draw(st.integers(2, most))])
    pairs = list(itertools.combinations(cards, 2))
    return cards, draw(st.lists(st.sampled_from(pairs), unique=True))


@given(graphs(), st.randoms(use_true_random=False))
def test_the_fewest_moves_are_those_found_by_trying_every_order(graph, chance):
    cards, before = graph
    order = tuple(chance.sample(cards, len(cards)))
    assert fewest_moves(order, transitive_closure(before)) == fewest_moves_by_trying(order, before)


@given(graphs(), st.randoms(use_true_random=False))
def test_any_order_that_respects_the_graph_is_right_and_no_other(graph, chance):
    cards, before = graph
    order = tuple(chance.sample(cards, len(cards)))
    assume(order != tuple(reversed(cards)))  # as they were dealt
    mark = mark_order(question_of(cards), answer_of(cards, before), list(order))
    assert (mark.status == "right") == respects(order, before)
    assert (mark.credit == 1) == respects(order, before)


@given(graphs(most=8), st.randoms(use_true_random=False))
def test_a_right_order_spoilt_by_lifting_cards_needs_no_more_moves_than_that(graph, chance):
    cards, before = graph
    order, lifted = list(cards), chance.randint(0, 3)
    for _ in range(lifted):
        order.insert(chance.randrange(len(cards)), order.pop(chance.randrange(len(cards))))
    assert fewest_moves(order, transitive_closure(before)) <= lifted


@given(graphs(most=8), st.randoms(use_true_random=False))
def test_one_more_move_of_a_card_changes_the_fewest_moves_by_at_most_one(graph, chance):
    cards, before = graph
    after = transitive_closure(before)
    order = chance.sample(cards, len(cards))
    moved = list(order)
    moved.insert(chance.randrange(len(cards)), moved.pop(chance.randrange(len(cards))))
    assert abs(fewest_moves(order, after) - fewest_moves(moved, after)) <= 1


@given(graphs(most=8), st.randoms(use_true_random=False))
def test_credit_falls_as_moves_rise_and_is_never_negative(graph, chance):
    cards, before = graph
    orders = [tuple(chance.sample(cards, len(cards))) for _ in range(8)]
    question, answer = question_of(cards), answer_of(cards, before)
    marks = [
        (fewest_moves(order, transitive_closure(before)), mark_order(question, answer, order))
        for order in orders
        if order != tuple(reversed(cards))
    ]
    for (fewer, better), (more, worse) in itertools.permutations(marks, 2):
        if fewer <= more:
            assert better.credit >= worse.credit
    for moves, mark in marks:
        assert mark.credit == pytest.approx(max(0, 1 - 2 * moves / len(cards)))


@given(graphs(), st.data())
def test_exchanging_interchangeable_cards_never_changes_the_mark(graph, data):
    cards, before = graph
    same = tuple(data.draw(st.lists(st.sampled_from(cards), min_size=2, max_size=3, unique=True)))
    order = tuple(data.draw(st.permutations(cards)))
    shuffled = data.draw(st.permutations(same))
    rename = dict(zip(same, shuffled, strict=True))
    exchanged = tuple(rename.get(card, card) for card in order)
    dealt = tuple(reversed(cards))
    assume(dealt not in (order, exchanged))
    question, answer = question_of(cards), answer_of(cards, before, same)
    one, other = mark_order(question, answer, order), mark_order(question, answer, exchanged)
    assert (one.credit, one.status) == (other.credit, other.status)
    assert one.credit >= mark_order(question, answer_of(cards, before), order).credit


@given(graphs())
def test_the_cards_as_they_were_dealt_are_not_attempted_even_if_that_is_right(graph):
    cards, before = graph
    dealt = list(reversed(cards))
    assert mark_order(question_of(cards), answer_of(cards, before), dealt).status == "not attempted"


def test_a_right_order_is_praised_and_every_card_of_it_is_right():
    cards = tuple("abc")
    mark = mark_order(question_of(cards), answer_of(cards, [("a", "b"), ("b", "c")]), list(cards))
    assert (mark.status, mark.credit, mark.alternative) == ("right", 1.0, "right")
    assert mark.feedback == "Every step comes after the steps it needs."
    assert [(part.label, part.right, part.feedback) for part in mark.parts] == [
        ("Card 1", True, ""), ("Card 2", True, ""), ("Card 3", True, ""),
    ]  # fmt: skip
    assert mark.understood == "text a › text b › text c"


def test_an_order_is_right_if_some_exchange_of_equal_cards_makes_it_so():
    answer = answer_of(tuple("abcd"), [("a", "b"), ("b", "c"), ("c", "d")], same=("a", "c"))
    assert is_right("abcd", answer)
    assert is_right("cbad", answer)
    assert not is_right("acbd", answer)
    assert not is_right("dcba", answer)


def test_the_closure_follows_chains():
    assert transitive_closure([("a", "b"), ("b", "c"), ("d", "c")]) == {
        "a": {"b", "c"},
        "b": {"c"},
        "d": {"c"},
    }


@pytest.fixture
def marker(toy) -> Marker:
    """Of the toy course: boil, stir, pour, stir, drink in a row; a cup any time before drink."""
    return Marker(toy.load(), seed=1)


RIGHT = ["cup", "boil", "stir", "pour", "stir_again", "drink"]


def test_the_free_card_may_stand_anywhere_before_the_last(marker):
    for place in range(5):
        order = RIGHT[1:]
        order.insert(place, "cup")
        assert marker.mark("Q1.2", order).status == "right"


def test_the_two_cards_of_one_text_may_be_exchanged(marker):
    mark = marker.mark("Q1.2", ["cup", "boil", "stir_again", "pour", "stir", "drink"])
    assert (mark.status, mark.credit, mark.alternative) == ("right", 1, "right")


def test_one_lifted_card_of_six_costs_a_third_and_names_the_mistake(marker):
    mark = marker.mark("Q1.2", ["cup", "pour", "boil", "stir", "stir_again", "drink"])
    assert mark.credit == pytest.approx(2 / 3)
    assert mark.points == 3.33
    assert (mark.status, mark.alternative) == ("partial", "cold water")
    assert mark.feedback == (
        "1 card would have to move. You pour before the water is hot; boil it first."
    )


def test_a_conflict_without_a_known_mistake_names_the_two_cards(marker):
    mark = marker.mark("Q1.2", ["boil", "stir", "pour", "stir_again", "drink", "cup"])
    assert mark.alternative == "one card misplaced"
    assert "only “Fetch a cup” is out of place: it stands too late" in mark.feedback
    assert "“Drink” stands before “Fetch a cup”" in mark.feedback


def test_two_lifted_cards_of_six_cost_two_thirds(marker):
    """In reverse, the stirs exchanged: stir, pour, stir and the cup may stay."""
    mark = marker.mark("Q1.2", RIGHT[::-1])
    assert mark.credit == pytest.approx(1 / 3)
    assert mark.feedback.startswith("2 cards would have to move.")


def test_three_lifted_cards_of_six_leave_nothing(marker):
    """Of drink, stir, stir, pour, boil, cup only stir, pour and the cup may stay."""
    mark = marker.mark("Q1.2", ["drink", "stir", "stir_again", "pour", "boil", "cup"])
    assert (mark.status, mark.credit) == ("wrong", 0)
    assert mark.feedback.startswith("3 cards would have to move.")


def test_the_explanation_lists_the_canonical_order(marker):
    explanation = marker.mark("Q1.2", RIGHT[::-1]).explanation
    assert explanation.startswith("1. Fetch a cup\n2. Boil the water\n3. Stir\n")
    assert explanation.endswith("a cup before the last step.")


def test_a_card_out_of_place_is_told_where_it_belongs(marker):
    mark = marker.mark("Q1.2", ["cup", "boil", "stir_again", "drink", "pour", "stir"])
    astray = [part for part in mark.parts if not part.right]
    assert [part.label for part in astray] == ["Card 4"]
    assert astray[0].explanation == "“Drink” comes after “Stir” and “Fetch a cup”."
    assert not any(part.explanation for part in mark.parts if part.right)


@pytest.mark.parametrize(
    "response", [RIGHT[1:], [*RIGHT, "cup"], ["boil", *RIGHT[1:]], [*RIGHT[:5], "x"], [1, 2], "cup"]
)
def test_a_response_that_does_not_name_every_card_once_is_unreadable(marker, response):
    assert marker.mark("Q1.2", response).status == "unreadable"


# The real question. Its keyed order is checked against the sheet in test_the_sheet.py.


def test_every_mistake_of_the_real_order_is_recognised_when_made_alone(real_course):
    marker = Marker(real_course, seed=1)
    answer = real_course.key["Q1.2"]
    for mistake in answer.alternatives:
        order = [card for card in answer.order if card != mistake.first]
        order.insert(order.index(mistake.second), mistake.first)
        mark = marker.mark("Q1.2", order)
        assert mark.alternative == mistake.name
        assert mistake.feedback in mark.feedback
        assert mark.status == "partial"


def test_a_shuffled_order_of_the_real_cards_is_marked_fast(real_course):
    """Twelve cards: trying all orders would take minutes."""
    marker, chance = Marker(real_course, seed=1), random.Random(3)
    order = list(real_course.key["Q1.2"].order)
    for _ in range(50):
        chance.shuffle(order)
        assert marker.mark("Q1.2", order).status in ("partial", "wrong")
