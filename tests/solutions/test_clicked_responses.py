"""Orders and lists of true and false, written from the prompts and the chapters alone.

No right one loses and no wrong one earns everything, under three seeds. What cannot be read is
refused before it is kept.
"""

import itertools

import numpy as np
import pytest

from autograder.errors import UsageError
from autograder.marking.marker import Marker
from autograder.questions.registry import kind_of

SEEDS = (1, 2, 3)

LEARN = ("collection_features", "fill_space", "cluster")
FILL = ("find_word", "link", "tree_ready")
ASK = ("test_features", "find_word_again", "look_up", "vote", "select")
TWINS = {"find_word": "find_word_again", "find_word_again": "find_word"}


def exchanged(order):
    """The two cards of one text in each other's place."""
    return [TWINS.get(card, card) for card in order]


def with_card(card, at, order):
    """A card put at a place among the others."""
    rest = [other for other in order if other != card]
    return [*rest[:at], card, *rest[at:]]


BEST = [*LEARN, "model_features", *FILL, *ASK]
RIGHT_ORDERS = [with_card("model_features", at, BEST) for at in range(4)]
RIGHT_ORDERS += [exchanged(order) for order in RIGHT_ORDERS]
RIGHT_ORDERS += [tuple(BEST), tuple(exchanged(BEST)), np.array(BEST), np.array(exchanged(BEST))]

WRONG_ORDERS = {
    "reversed": BEST[::-1],
    "reversed, and the twins exchanged": exchanged(BEST[::-1]),
    "the last step first": with_card("select", 0, BEST),
    "the first step last": with_card("collection_features", 11, BEST),
    "k-means before there is anything": with_card("cluster", 0, BEST),
    "k-means before the space is filled": with_card("cluster", 1, BEST),
    "filled before there are features": with_card("fill_space", 0, BEST),
    "ready once the words are learnt": with_card("tree_ready", 3, BEST),
    "ready before the link": with_card("tree_ready", 5, BEST),
    "ready at the end": with_card("tree_ready", 11, BEST),
    "ready after the test image": with_card("tree_ready", 7, BEST),
    "the model images after their words": with_card("model_features", 4, BEST),
    "the model images after the link": with_card("model_features", 5, BEST),
    "the model images last": with_card("model_features", 11, BEST),
    "linked before the word is found": with_card("link", 4, BEST),
    "linked after the lookup": with_card("link", 9, BEST),
    "the test image first": with_card("test_features", 0, BEST),
    "all features first": ["collection_features", "model_features", "test_features"]
    + [c for c in BEST if not c.endswith("features")],
    "the test image's word before its features": with_card("find_word_again", 7, BEST),
    "looked up before the word is found": with_card("look_up", 8, BEST),
    "voted before the lookup": with_card("vote", 9, BEST),
    "the winner before the votes": with_card("select", 10, BEST),
    "asked before the words are learnt": [*ASK, *LEARN, "model_features", *FILL],
    "filled before the words are learnt": ["model_features", *FILL, *LEARN, *ASK],
    "asked before it is filled": [*LEARN, *ASK, "model_features", *FILL],
    "each phase reversed": [*LEARN[::-1], *FILL[::-1], "model_features", *ASK[::-1]],
    "one phase reversed": [*LEARN, "model_features", *FILL, *ASK[::-1]],
    "by the alphabet": sorted(BEST),
}
NO_ORDERS = {
    "one left out": BEST[:-1],
    "one twice": [*BEST, "select"],
    "one for another": [*BEST[:-1], "vote"],
    "the same twin twice": [c.replace("_again", "") for c in BEST],
    "capitals": [c.capitalize() for c in BEST],
    "spaces": [c.replace("_", " ") for c in BEST],
    "one text": ", ".join(BEST),
    "in a list": [BEST],
    "a set": set(BEST),
    "numbers from 0": list(range(12)),
    "numbers in quotes": [str(n) for n in range(1, 13)],
    "numbers with a point": [float(n) for n in range(1, 13)],
    "places by card": {card: n for n, card in enumerate(BEST, 1)},
    "nothing": [],
    "none": None,
}

T, F = True, False
TRUTHS = {  # of the whole bank, as the chapters have it
    "Q1.1": [T, T, F, F, F, T, T, F, F, T],
    "Q2.1": [T, F, T, F, T, F, T, F, F, T],
    "Q3.1": [F, F, T, T, F, T, F, T, F, T],
}


def credits(course, id, response):
    """What a response given in code earns under each seed."""
    question = course.question(id)
    kept = kind_of(question).read_response(question, response)
    return [Marker(course, seed).mark(id, kept).credit for seed in SEEDS]


@pytest.fixture(scope="module")
def as_printed(real_course):
    """The order's cards by the numbers beside them."""
    numbers = {card: n for n, card in enumerate(real_course.question("Q1.2").start, 1)}
    return lambda order: [numbers[card] for card in order]


@pytest.mark.parametrize("order", RIGHT_ORDERS, ids=range(len(RIGHT_ORDERS)))
def test_a_right_order_never_loses(real_course, as_printed, order):
    assert credits(real_course, "Q1.2", order) == [1, 1, 1]
    assert credits(real_course, "Q1.2", np.array(as_printed(order))) == [1, 1, 1]
    assert credits(real_course, "Q1.2", tuple(as_printed(order))) == [1, 1, 1]


@pytest.mark.parametrize("order", WRONG_ORDERS.values(), ids=WRONG_ORDERS)
def test_a_wrong_order_never_earns_everything(real_course, as_printed, order):
    assert max(credits(real_course, "Q1.2", order)) < 1
    assert max(credits(real_course, "Q1.2", as_printed(order))) < 1


@pytest.mark.parametrize("order", NO_ORDERS.values(), ids=NO_ORDERS)
def test_what_does_not_name_each_card_once_is_refused(real_course, order):
    with pytest.raises(UsageError, match="names each card once"):
        credits(real_course, "Q1.2", order)


def drawn(course, id):
    """Each choice of statements that a student may get, with what is true of them."""
    written = course.varied[id]
    bank = dict(zip(written.table["statements"], TRUTHS[id], strict=True))
    for variant in range(written.variables.count):
        own = course.with_variants({id: variant})
        yield own, [bank[statement] for statement in own.question(id).statements]


def ways_to_give(truths):
    """The same list in other clothes."""
    return (truths, tuple(truths), np.array(truths), [np.bool_(one) for one in truths])


@pytest.mark.parametrize("id", TRUTHS)
def test_right_calls_never_lose(real_course, id):
    for course, truths in drawn(real_course, id):
        assert credits(course, id, truths) == [1, 1, 1]
    for response in ways_to_give(truths):
        assert credits(course, id, response) == [1, 1, 1]


@pytest.mark.parametrize("id", TRUTHS)
def test_calls_with_any_one_wrong_or_open_never_earn_everything(real_course, id):
    for course, truths in drawn(real_course, id):
        marker = Marker(course, seed=1)
        for other in itertools.product([True, False, None], repeat=len(truths)):
            if [*other] != truths:
                right = sum(said is true for said, true in zip(other, truths, strict=True))
                assert marker.mark(id, [*other]).credit == right / len(truths) < 1


@pytest.mark.parametrize("id", TRUTHS)
def test_what_is_no_list_of_truth_values_is_refused(real_course, id):
    *_, (course, truths) = drawn(real_course, id)
    for response in (
        [str(one) for one in truths],
        [str(one).lower() for one in truths],
        [int(one) for one in truths],
        [float(one) for one in truths],
        np.array(truths, dtype=int),
        np.array([truths]),
        ["yes" if one else "no" for one in truths],
        ", ".join(map(str, truths)),
        [n for n, one in enumerate(truths, 1) if one],
        truths[:-1],
        [*truths, True],
        dict(enumerate(truths)),
        [truths],
        None,
        True,
    ):
        with pytest.raises(UsageError, match=r"respond with a list of \d True or False"):
            credits(course, id, response)
