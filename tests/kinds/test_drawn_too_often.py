"""How much a function draws is compared to what its case asks for, and said where it differs."""

import math

import pytest

from autograder.kinds.function.draws import drew, other_draws, other_samples

NUMBERS = {"draws": (3, 5)}
SAMPLES = {"samples": (2, 3, 5)}


@pytest.mark.parametrize(("count", "sign"), [(0, -1), (2, -1), (3, 0), (4, 0), (5, 0), (6, 1)])
def test_the_ends_are_included(count, sign):
    assert drew(NUMBERS, {"drawn": count}) == sign
    assert drew(SAMPLES, {"sampled": [2, count]}) == sign
    assert drew(SAMPLES, {"drawn": 9, "sampled": [2, count]}) == sign
    asked = "" if sign == 0 else "at least 3 and at most 5"
    assert other_draws(NUMBERS, {"drawn": count}) == asked
    assert other_samples(SAMPLES, {"sampled": [2, count]}) == asked


def test_numbers_and_samples_are_asked_for_together():
    case = {**NUMBERS, **SAMPLES}
    assert drew(case, {"drawn": 4, "sampled": [2, 4]}) == 0
    assert drew(case, {"drawn": 4, "sampled": [2, 6]}) == 1
    assert drew(case, {"drawn": 6, "sampled": [2, 4]}) == 1
    assert drew(case, {"drawn": 2, "sampled": [2, 6]}) == -1  # the numbers are looked at first


def test_samples_of_another_size_are_not_counted():
    assert drew(SAMPLES, {"drawn": 1, "sampled": [3, 99]}) == 0
    assert other_samples(SAMPLES, {"sampled": [3, 99]}) == ""
    for outcome in ({}, {"drawn": 1}, {"sampled": None}):
        assert drew(SAMPLES, outcome) == 0
        assert other_samples(SAMPLES, outcome) == ""


def test_who_does_not_use_the_generator_draws_too_little():
    for outcome in ({}, {"drawn": None}, {"drawn": True}, {"drawn": 4.0}):
        assert drew(NUMBERS, outcome) == -1
        assert other_draws(NUMBERS, outcome) == ""


def test_nothing_is_asked_where_the_case_says_nothing():
    assert drew({}, {"drawn": 99, "sampled": [2, 99]}) == 0
    assert other_draws({}, {"drawn": 99}) == other_samples({}, {"sampled": [2, 99]}) == ""


@pytest.mark.parametrize(("most", "asked"), [(3, "3"), (math.inf, "3 or more")])
def test_what_is_asked_for_is_said_in_few_words(most, asked):
    assert other_draws({"draws": (3, most)}, {"drawn": 2}) == asked
    assert other_samples({"samples": (2, 3, most)}, {"sampled": [2, 2]}) == asked
