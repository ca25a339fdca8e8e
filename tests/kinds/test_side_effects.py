"""What a call does besides returning a value: change its input, draw random numbers, fail."""

import math
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
import sympy as sp

from autograder.exchange.replies import clean_evaluation
from autograder.kinds.function.inside.counted_draws import CountedDraws
from autograder.kinds.function.marking import agrees, close
from autograder.sandbox.inside.evaluate import evaluate


def outcome(function: Any, *args: Any) -> dict[str, Any]:
    """What comes back of one call, as it passes through the check of replies."""
    probe = {"kind": "function", "cases": [{"args": list(args)}]}
    return clean_evaluation(evaluate(function, probe))["outcomes"][0]


def right(case: dict[str, Any], expected: dict[str, Any], actual: dict[str, Any]) -> bool:
    return agrees(close, case, expected, actual)


def center_in_place(points):
    points -= points.mean(axis=0)
    return 1.0


def sort_in_place(groups):
    for group in groups:
        group.sort()
    return 1.0


def overwrite_an_entry(groups):
    groups[0] = 7
    return 1.0


@pytest.mark.parametrize(
    ("function", "argument"),
    [
        (center_in_place, np.array([[1.0, 2.0], [3.0, 4.0]])),
        (sort_in_place, [np.array([2, 1]), np.array([3])]),
        (sort_in_place, [[2, 1], [3]]),
        (overwrite_an_entry, [1, 2]),
    ],
)
def test_a_right_value_is_wrong_if_the_input_was_changed(function, argument):
    changed = outcome(function, argument)
    left_alone = outcome(lambda argument: 1.0, argument)
    assert changed == {"value": 1.0, "changed": True}
    assert left_alone == {"value": 1.0}
    assert not right({}, left_alone, changed)
    assert right({}, changed, changed)  # where the reference does so as well


@pytest.mark.parametrize(
    ("returned", "value"),
    [
        (Decimal("0.5"), 0.5),
        ([Decimal("Infinity"), Fraction(1, 2)], [math.inf, 0.5]),
        (sp.oo, math.inf),
        ([-sp.oo, sp.Rational(1, 2), sp.Integer(3)], [-math.inf, 0.5, 3]),
        (complex(2, 0), 2.0),
        (complex(2, 1), complex(2, 1)),
        (np.complex64(2), 2.0),
        ((1, complex(2, -0.0)), [1, 2.0]),
    ],
    ids=repr,
)
def test_a_number_of_any_library_comes_back_as_the_plain_one(returned, value):
    back = outcome(lambda: returned)["value"]
    assert back == value
    assert type(back) is type(value)


def test_an_array_of_complex_numbers_is_real_where_all_its_numbers_are():
    assert outcome(lambda: np.array([1 + 0j, 2]))["value"].dtype == float
    assert outcome(lambda: np.array([1 + 0j, 2 + 1e-9j]))["value"].dtype == complex


def test_an_input_that_holds_nan_is_not_taken_for_changed():
    assert "changed" not in outcome(lambda x, y: 1.0, np.array([np.nan]), float("nan"))


def test_counted_draws_are_those_of_the_usual_generator():
    counted, usual = CountedDraws(3), np.random.default_rng(3)
    for draw in (
        lambda rng: rng.choice(9, size=2, replace=False),
        lambda rng: rng.integers(5),
        lambda rng: rng.random((2, 3)),
        lambda rng: rng.permutation(4),
    ):
        np.testing.assert_array_equal(draw(counted), draw(usual))
    assert counted.drawn == 2 + 1 + 6 + 4
    counted.shuffle([1, 2, 3])
    assert counted.drawn == 16
    counted.shuffle(np.zeros((3, 2)), 1)
    assert counted.drawn == 22
    counted.shuffle(x=[1, 2])
    assert counted.drawn == 24


def test_every_way_to_ask_for_numbers_is_open():
    counted, usual = CountedDraws(3), np.random.default_rng(3)
    for draw in (
        lambda rng: rng.random(),
        lambda rng: rng.random(size=3),
        lambda rng: rng.choice(a=9, size=2, replace=False),
        lambda rng: rng.choice(size=2, a=9),
        lambda rng: rng.integers(high=9, low=0, size=2),
    ):
        np.testing.assert_array_equal(draw(counted), draw(usual))
    assert (counted.choice.__name__, counted.choice.__doc__) == ("choice", usual.choice.__doc__)


@pytest.mark.parametrize(
    ("draw", "sampled"),
    [
        (lambda rng: rng.choice(9, size=2, replace=False), (2, 4)),
        (lambda rng: rng.choice(np.zeros((9, 2)), (2,), False, shuffle=False), (2, 4)),
        (lambda rng: rng.choice(a=9, size=2, replace=False), (2, 4)),
        (lambda rng: rng.choice(9, 3, replace=False, p=np.full(9, 1 / 9)), (3, 4)),
        (lambda rng: rng.choice(9, size=2), None),  # the two may be equal
        (lambda rng: rng.choice(9, replace=False), None),
        (lambda rng: (rng.choice(9, 2, replace=False), rng.choice(9, 3, replace=False)), None),
        (lambda rng: (rng.choice(9, 2, replace=False), rng.integers(9)), None),
        (lambda rng: rng.permutation(9)[:2], None),
        (lambda rng: None, None),
    ],
)
def test_samples_are_counted_where_nothing_else_is_drawn(draw, sampled):
    counted = CountedDraws(3)
    for _ in range(4):
        draw(counted)
    assert counted.sampled == sampled


def draws(count):
    def function(rng):
        for _ in range(count):
            rng.choice(9, size=2, replace=False)
        return 1.0

    return outcome(function, {"rng": 5})


def test_a_function_that_does_not_draw_as_asked_is_wrong_whatever_it_returns():
    case = {"draws": (10, 40)}
    reference = draws(10)
    assert reference == {"value": 1.0, "drawn": 20, "sampled": [2, 10]}
    assert right(case, reference, draws(5))
    assert not right(case, reference, draws(4))
    assert not right(case, reference, draws(21))
    assert not right(case, reference, outcome(lambda rng: 1.0, {"rng": 5}))
    assert not right(case, reference, {"value": 1.0})
    assert right({}, reference, draws(4))  # nothing is asked here


def by_numbers(rng):
    for _ in range(40):
        rng.integers(9)
    return 1.0


def test_twice_as_many_samples_are_wrong_and_twice_as_many_numbers_are_not():
    case = {"draws": (10, 90), "samples": (2, 10, 10)}
    reference = draws(10)
    assert right(case, reference, outcome(by_numbers, {"rng": 5}))
    for count in (5, 9, 11, 20):
        assert not right(case, reference, draws(count))
    # Too many are another mistake than too few.
    assert right(case, draws(20), draws(40))
    assert not right(case, draws(20), draws(5))


@pytest.mark.parametrize("sampled", [None, 20, [2], [2, 10, 1], [2, "10"], [2, True], {2: 10}])
def test_forged_samples_are_none(sampled):
    entry = {"value": 1.0, "drawn": 20, "sampled": sampled}
    (cleaned,) = clean_evaluation({"state": "given", "outcomes": [entry]})["outcomes"]
    assert cleaned == {"value": 1.0, "drawn": 20}


@pytest.mark.parametrize("drawn", [None, "20", 20.0, True, [20], np.array([20])])
def test_a_forged_count_is_no_count(drawn):
    (cleaned,) = clean_evaluation({"state": "given", "outcomes": [{"value": 1.0, "drawn": drawn}]})[
        "outcomes"
    ]
    assert "drawn" not in cleaned
    assert not right({"draws": (10, 40)}, {"value": 1.0, "drawn": 20}, cleaned)


class NoLine(ValueError):
    """An exception of a student's own."""


def raising(error):
    def function(x):
        raise error

    return outcome(function, 1.0)


def test_an_exception_of_a_more_special_class_is_the_one_that_was_asked_for():
    expected = {"raised": "ValueError"}
    for error in (ValueError(), NoLine(), np.linalg.LinAlgError(), UnicodeError()):
        assert right({}, expected, raising(error)), type(error)
    for error in (TypeError(), Exception(), IndexError(), ZeroDivisionError()):
        assert not right({}, expected, raising(error)), type(error)
    assert not right({}, {"raised": "UnicodeError"}, raising(ValueError()))
    assert not right({}, expected, {"value": 1.0})


def test_a_case_may_say_that_an_exception_is_as_right_as_the_value():
    case, expected = {"may_raise": "ValueError"}, {"value": np.inf}
    assert right(case, expected, raising(ValueError()))
    assert right(case, expected, {"value": np.inf})
    assert not right(case, expected, raising(ZeroDivisionError()))
    assert not right(case, expected, {"value": 0.0})
    assert not right({}, expected, raising(ValueError()))


def test_children_of_a_generator_are_numpys_own_and_draw_on_its_account():
    counted, plain = CountedDraws(5), np.random.default_rng(5)
    children, others = counted.spawn(3), plain.spawn(3)
    assert [child.random() for child in children] == [other.random() for other in others]
    assert counted.drawn == 3
    grandchild, other = children[1].spawn(1)[0], others[1].spawn(1)[0]
    assert grandchild.random(4).tolist() == other.random(4).tolist()
    assert counted.drawn == children[2].drawn == 7
    sampled = CountedDraws(5)
    for child in sampled.spawn(2):
        child.choice(9, size=2, replace=False)
    assert sampled.sampled == (2, 2)
