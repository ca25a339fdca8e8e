"""What a change of the reference may be called when students are to hear of it."""

from __future__ import annotations

from pathlib import Path

from autograder.kinds.function.hypotheses import Hypotheses
from autograder.kinds.function.marking import agrees, close
from autograder.kinds.function.trial import outcome_of

ROOT = Path(__file__).parents[2]


def said(reference, response, *arguments):
    """What is said to a response by the changes of a reference alone."""
    cases = [{"name": "a case", "args": [*each]} for each in arguments]
    right = [outcome_of(reference, case) for case in cases]
    given = [outcome_of(response, case) for case in cases]
    verdicts = [agrees(close, *each) for each in zip(cases, right, given, strict=True)]
    return Hypotheses(reference, cases, close, ROOT).explain(right, given, verdicts)


def longer_side(width, height):
    """Refuses what has no longer side by one comparison of a product."""
    if width * (width - height) == 0:
        raise ValueError("no side is the longer one")
    return max(width, height)


def for_any_square(width, height):
    if width == 0:
        raise ValueError("nothing")
    return max(width, height)


def for_any(width, height):
    return max(width, height)


SIDES = (2, 1), (1, 3), (0, 4), (3, 3), (2, 2)


def test_an_error_that_is_missing_is_not_put_down_to_a_sum():
    """With a plus for the minus the same inputs would pass, and nobody had that in mind."""
    found = said(longer_side, for_any_square, *SIDES)
    assert found.name == "a value for an error"
    assert "an error is to be raised" in found.sentence


def test_a_guard_that_explains_a_missing_error_is_named():
    assert said(longer_side, for_any, *SIDES).name == "branch left out"


def up_to(numbers, count):
    return numbers[:count]


def first_ones(numbers, count):
    if count == 0:
        return []
    return up_to(numbers, count)


def first_ones_of_nothing(numbers, count):
    """What a function that it calls should have returned is None."""
    numbers = None
    return [] if count == 0 else numbers[:count]


def test_what_only_raises_is_not_put_down_to_a_change_that_raises_the_same():
    """Exchanged arguments raise TypeError here as well, and so would much else."""
    assert said(first_ones, first_ones_of_nothing, ([1, 2], 0), ([3, 1], 1), ([5, 2], 2)) is None


def power_of_extremes(numbers):
    big, small = max(numbers), min(numbers)
    return big**small


def test_names_that_only_the_reference_has_are_not_told():
    found = said(
        power_of_extremes, lambda numbers: min(numbers) ** max(numbers), [[2, 3]], [[5, 3]]
    )
    assert found.name == "two quantities exchanged"
    assert "big" not in found.sentence
    assert "big ** small -> " in found.evidence


def power(base, exponent):
    return base**exponent


def test_arguments_are_told_by_their_names():
    found = said(power, lambda base, exponent: exponent**base, (2, 3), (5, 3))
    assert found.name == "base and exponent exchanged"
