"""Probes: hidden points and inputs are drawn by seed, and nothing of the key is sent."""

import re

import numpy as np
import pytest

from autograder.course.loading import load_object
from autograder.errors import CourseError
from autograder.exchange import wire
from autograder.kinds.expression.answer import ExpressionAnswer
from autograder.kinds.expression.marking import POINT_COUNT, hidden_points
from autograder.marking.draw import draw


def drawn(course, id, seed):
    return draw(course.question(id), course.key[id], seed, course.root)


def test_the_same_seed_draws_the_same_points_and_another_one_others(toy):
    course = toy.load()
    first, again, other = (drawn(course, "Q1.4", seed).expected for seed in (1, 1, 2))
    assert all(np.array_equal(first[name], again[name]) for name in first)
    assert not np.array_equal(first["a"], other["a"])
    assert not np.array_equal(first["a"], first["b"])


def test_points_lie_in_their_ranges_and_derived_symbols_follow(toy):
    points = drawn(toy.load(), "Q1.4", 3).expected
    for name in ("a", "b"):
        assert points[name].shape == (2 * POINT_COUNT,)
        assert points[name].min() >= 1
        assert points[name].max() <= 5
        assert np.ptp(points[name]) > 2
    assert np.array_equal(points["half"], points["a"] + points["b"])


def test_in_the_second_half_only_what_the_response_must_be_free_of_differs():
    answer = ExpressionAnswer(
        id="Q9", explanation="", code="", alternatives=(), free_of_feedback="",
        sample={"r": (0.0, 1.0), "x": (2.0, 3.0)}, derived={"rx": "r*x", "xx": "x*x"},
        free_of=("r",),
    )  # fmt: skip
    points = hidden_points(answer, np.random.default_rng(4))
    halves = {name: np.split(values, 2) for name, values in points.items()}
    same = {name for name, (first, second) in halves.items() if np.array_equal(first, second)}
    assert same == {"x", "xx"}


def test_what_is_sent_can_cross_and_holds_arguments_only(toy):
    course = toy.load()
    for id in ("Q1.3", "Q1.4", "Q1.5"):
        assert wire.encode(drawn(course, id, 1).probe)
    sent = drawn(course, "Q1.5", 1).probe
    assert sent.keys() == {"kind", "cases"}
    assert all(case.keys() == {"args", "kwargs"} for case in sent["cases"])


def test_the_reference_and_the_mistakes_are_run_on_the_cases_that_are_sent(toy):
    ready = drawn(toy.load(), "Q1.5", 6)
    weights = [case["args"][0] for case in ready.probe["cases"]]
    means = [sum(some) / len(some) if some else 0 for some in weights]
    assert [outcome["value"] for outcome in ready.expected.outcomes] == pytest.approx(means)
    mistake, outcomes = ready.expected.mistakes[0]
    assert mistake.name == "the sum"
    assert [outcome["value"] for outcome in outcomes] == pytest.approx([sum(s) for s in weights])


@pytest.mark.parametrize(
    "name",
    ["solutions.kitchen", "solutions.kitchen:", "solutions.attic:mean", "kitchen:mean", ":", ""],
)
def test_a_name_that_cannot_be_loaded_is_said(toy, name):
    with pytest.raises(CourseError, match="cannot be loaded"):
        load_object(name, toy.root)


@pytest.mark.parametrize(
    ("cases", "said"),
    [
        ("[]", "cases of Q1.5 must be a list"),
        ("None", "cases of Q1.5 must be a list"),
        ("{}", "cases of Q1.5 must be a list"),
        ("[3]", "Case 1 of Q1.5: write a dictionary"),
        ('[{"name": "x"}]', "Case 'x' of Q1.5: it needs \"args\""),
        ('[{"args": []}]', 'Case 1 of Q1.5: it needs a "name"'),
        ('[{"name": "x", "args": [], "hidden": True}]', "Case 'x' of Q1.5: unknown key 'hidden'"),
        ('[{"name": "x", "args": [], "pubic": True}]', "perhaps 'public' is meant"),
        ('[{"name": 3, "args": []}]', 'it needs a "name"'),
        ('[{"name": "x", "args": 3}]', 'it needs "args"'),
    ],
)
def test_malformed_cases_are_said(toy, cases, said):
    toy.append("solutions/kitchen.py", f"\n\ndef some_cases(rng):\n    return {cases}\n")
    toy.replace("solutions/answers/kitchen.toml", "kitchen:mean_weight_cases", "kitchen:some_cases")
    with pytest.raises(CourseError, match=re.escape(said)):
        drawn(toy.load(), "Q1.5", 1)


def test_a_reference_that_is_a_stub_is_said(toy):
    toy.replace("solutions/kitchen.py", "    total = sum(weights)", "    raise NotImplementedError")
    with pytest.raises(CourseError, match="mean_weight gives no outcomes"):
        drawn(toy.load(), "Q1.5", 1)


def test_a_random_generator_as_an_argument_is_the_same_for_both_sides(toy):
    """It crosses as its seed."""
    toy.append(
        "solutions/kitchen.py",
        '\n\ndef roll(rng):\n    """Roll a die."""\n    return int(rng.integers(1, 7))\n'
        '\n\ndef rolls(rng):\n    return [{"name": "a die", "args": [{"rng": 7}]}]\n',
    )
    answers = "solutions/answers/kitchen.toml"
    toy.replace(answers, "kitchen:mean_weight_cases", "kitchen:rolls")
    toy.replace(answers, '"solutions.kitchen:mean_weight"', '"solutions.kitchen:roll"')
    text = (toy.root / answers).read_text().partition('[["Q1.5".alternative]]')[0]
    (toy.root / answers).write_text(text)
    ready = drawn(toy.load(), "Q1.5", 1)
    assert ready.probe["cases"][0]["args"] == [{"rng": 7}]
    expected = int(np.random.default_rng(7).integers(1, 7))
    assert ready.expected.outcomes == [{"value": expected, "drawn": 1}]
