"""A name hangs on the response alone: not on the clock, nor on what was marked before."""

from __future__ import annotations

import re
from itertools import count
from pathlib import Path

import numpy as np
import pytest

from autograder.course import load_course
from autograder.diagnosis.effort import Effort, lines_run, numbers_in
from autograder.exchange.why_unusable import REASONS
from autograder.kinds.function import hypotheses
from autograder.kinds.function.diagnosis import diagnose_function
from autograder.kinds.function.hypotheses import Hypotheses
from autograder.kinds.function.marking import agrees, close
from autograder.marking.marker import Marker

ENGINE = Path(hypotheses.__file__).parents[2]
ROOT = Path(__file__).parents[2]
NUMBERS = ([3, 1, 2], [5, 5], [0, 4, 9, 2], [7])


def largest_below(numbers, limit):
    """A reference whose loop, in a helper, ends only for a limit that is no list."""
    return largest([number for number in numbers if number < limit])


def largest(numbers):
    best = 0
    for number in numbers:
        best = max(best, number)
    return best


def counts_up_to(limit, step):
    total = 0
    for _ in steps_to(limit, step):
        total += 1
    return total


def steps_to(limit, step):
    found = []
    for number in count(0, step):
        if number >= limit:
            break
        found.append(number)
    return found


def cases(*arguments):
    return [{"name": f"case {i}", "args": list(args)} for i, args in enumerate(arguments)]


def explain(known, reference, response, asked):
    right = [{"value": reference(*case["args"])} for case in asked]
    given = [{"value": response(*case["args"])} for case in asked]
    verdicts = [agrees(close, *entry) for entry in zip(asked, right, given, strict=True)]
    found = known.explain(right, given, verdicts)
    return found and found.name


BELOW = cases(*((numbers, 5) for numbers in NUMBERS))


def at_most(numbers, limit):
    return largest([number for number in numbers if number <= limit])


def smallest(numbers, limit):
    return min([number for number in numbers if number < limit], default=0)


@pytest.mark.parametrize("most", [500, 2_000, 5_000, 20_000, 20_000_000])
def test_the_name_is_the_same_whatever_was_marked_before(monkeypatch, most):
    monkeypatch.setattr(hypotheses, "_MOST_LINES", most)
    alone = {}
    for response in (at_most, smallest):
        known = Hypotheses(largest_below, BELOW, close, ROOT)
        alone[response] = explain(known, largest_below, response, BELOW)
    for order in ((at_most, smallest), (smallest, at_most), (at_most, at_most)):
        known = Hypotheses(largest_below, BELOW, close, ROOT)
        for response in order:
            assert explain(known, largest_below, response, BELOW) == alone[response]


def test_few_steps_give_no_name_and_enough_give_one(monkeypatch):
    known = Hypotheses(largest_below, BELOW, close, ROOT)
    assert explain(known, largest_below, at_most, BELOW) == "comparison loose"
    monkeypatch.setattr(hypotheses, "_MOST_LINES", 100)
    assert explain(known, largest_below, at_most, BELOW) is None


def test_a_helper_that_never_ends_is_left():
    """Exchanged arguments and a step of nothing make the helper count for ever."""
    asked = cases((6, 2), (9, 3), (8, 1))
    known = Hypotheses(counts_up_to, asked, close, ROOT)
    assert explain(known, counts_up_to, lambda limit, step: -5, asked) is None
    for index, (mutant, _) in enumerate(known._changes()):
        if mutant.name == "steps_to: break -> pass":
            lost = known._outcome(index, 0, {"value": 3})[0]
            assert [*lost] == ["unusable"]
            assert lost["unusable"] not in REASONS  # as no response comes back
            break
    else:
        raise AssertionError("The change that never ends was not made.")


SEARCHES: list[int] = []


def count_by_searching(things, least):
    """Each turn of its loop is a search, which runs many lines."""
    found = 0
    while len(things) >= least:
        SEARCHES.append(sum(thing for _ in range(100) for thing in things))
        things = things[1:]
        found += 1
    return found


def test_what_never_ends_is_left_after_so_many_turns_however_much_a_turn_costs():
    """Counted in lines, thousands of searches were allowed for each change that never ends."""
    known = Hypotheses(count_by_searching, cases(([4, 5, 6], 2)), close, ROOT)
    most = 0
    for index in range(len(known._changes())):
        known._turns_by_case(known._origins[index])
        SEARCHES.clear()
        known._outcome(index, 0, {"value": 2})
        most = max(most, len(SEARCHES))
    turns = 2
    assert hypotheses._TURNS_AT_LEAST < most <= hypotheses._TURNS_AT_LEAST + 20 * turns


def test_every_change_can_be_said_in_words():
    """In right work of every style: one that cannot would cost its whole question all names."""
    marker = Marker(load_course(ROOT), 5)
    known = [Hypotheses(largest_below, BELOW, close, ROOT)]
    for id in ("Q1.3", "Q1.7", "Q2.3", "Q3.7a"):
        known.append(marker.drawn(id).expected.hypotheses)
    for hypotheses_of in known:
        changes = hypotheses_of._changes()
        assert changes
        for index, (mutant, _) in enumerate(changes):
            sentence = hypotheses_of._said(index).sentence
            assert sentence.startswith("It looks as if"), mutant.name
    operators = {mutant.operator for each in known for mutant, _ in each._changes()}
    assert {"argument ignored", "argument doubled", "argument one less"} <= operators


def spread_out(numbers):
    return largest(*[numbers])


def test_what_is_spread_out_is_not_changed_to_what_is_no_python():
    asked = cases(([3, 1],), ([2, 7],))
    known = Hypotheses(spread_out, asked, close, ROOT)
    assert explain(known, spread_out, lambda numbers: 2 * max(numbers), asked) is not None


def test_no_diagnosis_looks_at_a_clock():
    modules = [*ENGINE.glob("kinds/*/diagnosis.py"), *ENGINE.glob("diagnosis/*.py")]
    modules += [
        ENGINE / "kinds/function/called_otherwise.py",
        ENGINE / "kinds/function/hypotheses.py",
        ENGINE / "kinds/function/right_but_for_form.py",
    ]
    assert len(modules) >= 6
    for module in modules:
        text = module.read_text(encoding="utf-8")
        assert not re.search(r"^(import|from) (time|signal)\b", text, re.MULTILINE), module


def test_huge_results_are_left_without_a_name():
    huge = [{"value": np.zeros(600_000)}, {"value": np.ones(600_000)}]
    right = [{"value": np.arange(3.0)}, {"value": np.arange(4.0)}]
    compared = []

    def same(_case, one, other):
        compared.append(np.size(other))
        return close({}, one, other)

    asked = cases(([1, 2],), ([3, 4],))
    assert diagnose_function(asked, right, huge, [False, False], same) is None
    assert sum(compared) <= 1_200_000


@pytest.mark.parametrize(
    ("value", "numbers"),
    [(1.5, 1), (np.zeros((3, 4)), 12), ([np.zeros(5), 1], 7), ({"value": [1, 2]}, 4), ([], 1)],
)
def test_numbers_are_counted_in_arrays_and_lists(value, numbers):
    assert numbers_in(value) == numbers


def test_counting_ends_above_the_most():
    assert numbers_in([[0] * 10] * 1000, most=50) <= 70


def test_lines_are_counted_again_alike_and_an_endless_call_is_left():
    def three():
        one = 1
        two = one + 1
        return two

    assert lines_run(three, 100) == lines_run(three, 100) == 3

    def endless():
        while True:
            pass

    assert lines_run(endless, 50) is None


def test_effort_is_used_up():
    effort = Effort(10)
    assert effort.spend(6)
    assert effort.spend(4)
    assert not effort.spend(1)
