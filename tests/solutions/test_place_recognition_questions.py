"""The cases of the place recognition questions tell the references and all mistakes apart."""

import inspect
import itertools
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from autograder.exchange.wire import decode, encode
from autograder.kinds.function.marking import close
from solutions import place_recognition
from solutions.cases import place_recognition as made
from solutions.mistakes import place_recognition as mistakes

QUESTIONS: dict[str, tuple[Callable, list[Callable]]] = {
    "assign_words": (
        close,
        [
            mistakes.largest_product,
            mistakes.city_block_distance,
            mistakes.nearest_descriptor_of_each_word,
            mistakes.farthest_word,
        ],
    ),
    "descend_tree": (
        close,
        [
            mistakes.nearest_leaf_of_all,
            mistakes.position_among_siblings,
            mistakes.children_start_at_the_node,
            mistakes.numbers_all_nodes,
        ],
    ),
    "build_inverted_file": (
        made.same_inverted_file,
        [
            mistakes.lists_every_occurrence,
            mistakes.shares_one_list,
            mistakes.keeps_the_last_image,
            mistakes.lists_words_of_images,
        ],
    ),
    "count_votes": (
        close,
        [
            mistakes.votes_once_for_each_word,
            mistakes.adds_all_at_once,
            mistakes.forgets_images_at_the_end,
            mistakes.returns_the_winner,
        ],
    ),
    "idf_weights": (
        close,
        [
            mistakes.counts_occurrences,
            mistakes.takes_the_decadic_logarithm,
            mistakes.turns_the_fraction_round,
            mistakes.divides_by_no_images,
        ],
    ),
    "l1_scores": (
        close,
        [
            mistakes.does_not_normalise,
            mistakes.uses_the_euclidean_norm,
            mistakes.forgets_the_weights,
            mistakes.prefers_empty_images,
            mistakes.divides_by_zero,
        ],
    ),
}


def across(value: Any) -> Any:
    """What arrives of a value on the other side of the process boundary."""
    frame = encode(value)
    length = int.from_bytes(frame[:4], "big")
    return decode(frame[12 : 12 + length].decode(), frame[12 + length :])


def make_cases(question: str, seed: int) -> list[dict]:
    return getattr(made, f"{question}_cases")(np.random.default_rng(seed))


def results(function: Callable, cases: list[dict]) -> list[Any]:
    return [across(function(*across(case["args"]))) for case in cases]


@pytest.mark.parametrize("question", QUESTIONS)
@pytest.mark.parametrize("seed", range(20))
def test_the_cases_tell_all_implementations_apart(question, seed):
    compare, wrong = QUESTIONS[question]
    cases = make_cases(question, seed)
    functions = [getattr(place_recognition, question), *wrong]
    given = {function.__name__: results(function, cases) for function in functions}
    for name, values in given.items():
        assert all(map(compare, cases, values, values)), f"{name} is not recognised as itself"
    for one, other in itertools.combinations(given, 2):
        same = all(map(compare, cases, given[one], given[other]))
        assert not same, f"{one} and {other} agree on all cases"


@pytest.mark.parametrize("question", QUESTIONS)
def test_a_reference_needs_only_its_source_and_numpy(question):
    reference = getattr(place_recognition, question)
    given: dict[str, Any] = {"np": np}
    exec(inspect.getsource(reference), given)  # what the solved notebook does
    for case in make_cases(question, 0):
        assert close(case, across(reference(*case["args"])), across(given[question](*case["args"])))


@pytest.mark.parametrize("question", QUESTIONS)
def test_one_case_is_public_and_the_others_change_with_the_seed(question):
    one, other = make_cases(question, 0), make_cases(question, 1)
    assert [bool(case.get("public")) for case in one] == [True] + [False] * (len(one) - 1)
    for first, second in zip(one, other, strict=True):
        fixed = first.get("public") or first["name"] == "no images"
        assert (encode(first["args"]) == encode(second["args"])) == bool(fixed)


@pytest.mark.parametrize(
    ("question", "by_hand"),
    [
        ("assign_words", [0, 1, 1]),
        ("descend_tree", 2),
        ("build_inverted_file", [[0, 1], [0], [1], []]),
        ("count_votes", [2, 2, 1]),
        ("idf_weights", [0, np.log(2), np.log(4), 0]),
        ("l1_scores", [0, 1.5, 1]),
    ],
)
def test_the_public_cases_come_out_as_worked_by_hand(question, by_hand):
    case = make_cases(question, 0)[0]
    value = getattr(place_recognition, question)(*case["args"])
    if question == "build_inverted_file":
        assert value == by_hand
    else:
        np.testing.assert_allclose(value, by_hand, atol=1e-12)


@pytest.mark.parametrize("seed", range(20))
def test_the_nearest_word_is_the_same_with_distances_written_out(seed):
    for case in make_cases("assign_words", seed):
        descriptors, words = case["args"]
        naive = [
            min(range(len(words)), key=lambda k, x=x: float(((x - words[k]) ** 2).sum()))
            for x in descriptors
        ]
        assert place_recognition.assign_words(descriptors, words).tolist() == naive


@pytest.mark.parametrize("seed", range(20))
def test_l1_scores_are_sums_of_absolute_differences(seed):
    for case in make_cases("l1_scores", seed):
        query, histograms, weights = case["args"]
        q = query * weights
        expected = []
        for histogram in histograms:
            d = histogram * weights
            nothing = q.sum() == 0 or d.sum() == 0
            expected.append(2.0 if nothing else np.abs(q / q.sum() - d / d.sum()).sum())
        scores = place_recognition.l1_scores(query, histograms, weights)
        np.testing.assert_allclose(scores, expected, atol=1e-12)


@pytest.mark.parametrize("rubbish", [None, 3, "ab", [], [[0]], [[0], [1, "x"]], [0.5, None], {}])
def test_rubbish_is_never_the_same_inverted_file(rubbish):
    assert not made.same_inverted_file({}, [[0], [1]], rubbish)


def test_the_order_within_a_list_is_forgiven_and_repeats_are_not():
    assert made.same_inverted_file({}, [[0, 2], []], [np.array([2, 0]), []])
    assert not made.same_inverted_file({}, [[0, 2], []], [[0, 2, 2], []])
