"""What the mark of a function says, straight from outcomes: no function is run here."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest

from autograder.diagnosis.relations import Diagnosis
from autograder.kinds.function.answer import FunctionAlternative, FunctionAnswer
from autograder.kinds.function.expected import problem_of_cases
from autograder.kinds.function.hints import hints
from autograder.kinds.function.marking import (
    Expected,
    agrees,
    close,
    fingerprint,
    mark_function,
    nearly,
)
from autograder.kinds.function.question import Function
from autograder.kinds.function.reference_failures import other_counts
from autograder.marking import Mark

QUESTION = Function(
    id="Q9", chapter="c", title="t", prompt="p", points=8.0, hints=("h",), function="f"
)
CASES: list[dict[str, Any]] = [
    {"name": "small", "args": [2.0], "public": True},
    {"name": "small", "args": [3.0]},
    {"name": "large", "args": [300.0]},
    {"name": "odd", "args": [7.0]},
]
RIGHT: list[dict[str, Any]] = [{"value": value} for value in (1.3, 2.9, 17.1, 4.7)]
OFF: list[dict[str, Any]] = [{"value": value} for value in (8.6, 3.1, 5.9, 2.3)]
NO_VALUE = "On at least one of these it gives nothing that can be compared"


class Says:
    """A hypothesis that explains everything in one way, or cannot."""

    def __init__(self, found: Diagnosis | None = None, error: Exception | None = None) -> None:
        self.found, self.error, self.seen = found, error, []

    def explain(
        self, right: Sequence[Any], outcomes: Sequence[Any], verdicts: Sequence[bool]
    ) -> Diagnosis | None:
        self.seen.append((right, outcomes, verdicts))
        if self.error is not None:
            raise self.error
        return self.found


def mistake(name: str, credit: float) -> FunctionAlternative:
    return FunctionAlternative(name=name, credit=credit, feedback=f"On {name}.", function="m:f")


def mark(
    outcomes: Any,
    cases: list[dict[str, Any]] = CASES,
    right: list[dict[str, Any]] = RIGHT,
    mistakes: Sequence[tuple[FunctionAlternative, list[dict[str, Any]]]] = (),
    picture: str | None = None,
    hypotheses: Says | None = None,
    compare: Any = close,
    **how: bool,
) -> Mark:
    answer = FunctionAnswer(
        id="Q9", explanation="why", reference="m:f", cases="m:c", picture=picture,
        alternatives=tuple(entry for entry, _ in mistakes),
    )  # fmt: skip
    expected = Expected(cases, right, compare, mistakes, hypotheses)
    return mark_function(QUESTION, answer, expected, outcomes, **how)


def but(index: int, outcome: Any, of: list[dict[str, Any]] = RIGHT) -> list[Any]:
    """The right outcomes, but for one of them."""
    return [outcome if i == index else entry for i, entry in enumerate(of)]


def labels(verdict: Mark) -> list[str]:
    return [part.label + part.feedback for part in verdict.parts if not part.right]


def test_right_is_right_on_so_many_kinds_of_input():
    verdict = mark(RIGHT)
    assert (verdict.status, verdict.points, verdict.alternative) == ("right", 8.0, "right")
    assert verdict.feedback == "Right on all 3 kinds of input."
    assert verdict.explanation == "why"
    assert [(part.label, part.right) for part in verdict.parts] == [
        ("small", True), ("large", True), ("odd", True),
    ]  # fmt: skip


@pytest.mark.parametrize("place", [0, 1, 2])
def test_each_of_several_mistakes_is_known_wherever_it_stands(place):
    known = [(mistake(name, credit), but(i, OFF[i])) for i, name, credit in
             [(1, "one", 0.25), (2, "two", 0.5), (3, "three", 0.75)]]  # fmt: skip
    verdict = mark(known[place][1], mistakes=known)
    expected = known[place][0]
    assert (verdict.status, verdict.alternative) == ("partial", expected.name)
    assert (verdict.feedback, verdict.points) == (expected.feedback, 8 * expected.credit)
    assert verdict.explanation == "why"


def test_a_mistake_is_wrong_where_it_is_wrong_and_in_the_same_way():
    known = [(mistake("one", 0.5), but(1, OFF[1]))]
    assert mark(but(1, OFF[1]), mistakes=known).alternative == "one"
    assert mark(but(1, OFF[0]), mistakes=known).alternative != "one"
    assert mark(but(2, OFF[1]), mistakes=known).alternative != "one"
    also_here = [*but(1, OFF[1])[:3], OFF[3]]
    assert mark(also_here, mistakes=known).alternative != "one"
    two = [(mistake("two", 0.5), also_here)]
    assert mark(but(1, OFF[1]), mistakes=two).alternative != "two"


def test_a_mistake_counts_from_its_first_case_to_its_last():
    for place in (0, 3):
        known = [(mistake("one", 0.5), but(place, OFF[place]))]
        assert mark(but(place, OFF[place]), mistakes=known).alternative == "one"
        assert mark(but(place, OFF[1]), mistakes=known).alternative != "one"
    with pytest.raises(ValueError, match="zip"):
        mark(but(3, OFF[3]), mistakes=[(mistake("one", 0.5), RIGHT[:3])])


def test_where_a_mistake_is_right_it_may_be_right_in_another_way():
    def roughly(case: Any, expected: Any, actual: Any) -> bool:
        return abs(expected - actual) < 1

    known = [(mistake("one", 0.5), [OFF[0], *RIGHT[1:3], {"value": 4.0}])]
    verdict = mark([OFF[0], *RIGHT[1:3], {"value": 5.4}], mistakes=known, compare=roughly)
    assert verdict.alternative == "one"
    refused, special = {"raised": "ValueError"}, {"raised": "LinAlgError"}
    known = [(mistake("one", 0.5), [OFF[0], *RIGHT[1:3], special])]
    right = but(3, refused)
    verdict = mark([OFF[0], *RIGHT[1:3], refused], right=right, mistakes=known)
    assert verdict.alternative == "one"


def test_a_more_special_exception_is_right_and_a_more_general_one_is_not():
    refused = {"raised": "ValueError"}
    asked = but(3, refused)
    for given, fits in (("ValueError", True), ("LinAlgError", True), ("Exception", False)):
        assert (mark(but(3, {"raised": given}), right=asked).status == "right") == fits
        known = [(mistake("refuses", 0.5), asked)]
        verdict = mark(but(3, {"raised": given}), mistakes=known)
        assert (verdict.alternative == "refuses") == fits


def test_a_number_of_outcomes_that_is_not_that_of_the_cases_is_none():
    for outcomes in (RIGHT[:3], [*RIGHT, RIGHT[0]], tuple(RIGHT), None):
        verdict = mark(outcomes)
        assert (verdict.status, verdict.credit) == ("wrong", 0)
        assert all("not a number, text, list" in part.feedback for part in verdict.parts)


def test_what_is_drawn_is_what_was_returned_for_the_first_public_case():
    assert mark(RIGHT, picture="m:p").shown == 1.3
    assert mark(but(1, OFF[1]), picture="m:p").shown == 1.3
    assert mark(RIGHT).shown is None
    hidden_first = [{**CASES[0], "public": False}, *CASES[1:]]
    assert mark(RIGHT, hidden_first, picture="m:p").shown is None


def test_partial_credit_and_how_far_it_went():
    verdict = mark(but(2, OFF[2]))
    assert (verdict.status, verdict.credit, verdict.points) == ("partial", 0.66, 5.28)
    assert verdict.feedback == "Right on 2 of 3 kinds of input. Not yet on: large."
    assert verdict.explanation == "why"
    verdict = mark([*but(2, OFF[2])[:3], OFF[3]], mistakes=[(mistake("x", 0.25), OFF)])
    assert verdict.credit == 0.25
    assert verdict.feedback.startswith("Right on 1 of 3 kinds of input. Not yet on: large; odd.")


def test_a_kind_that_a_constant_gets_right_earns_nothing_by_the_questions_own_measure():
    zero = but(2, {"value": 0.0})
    assert mark(but(3, OFF[3], zero), right=zero).credit == 0.5
    case = [*CASES[:2], {**CASES[2], "draws": (3, 5)}, CASES[3]]
    drawn = but(2, {"value": 0.0, "drawn": 4})
    assert mark(but(3, OFF[3], drawn), case, drawn).credit == 0.5

    def or_nothing(case: Any, expected: Any, actual: Any) -> bool:
        return actual == expected or (expected, actual) == (17.1, 0)

    assert mark(but(3, OFF[3]), compare=or_nothing).credit == 0.5


@pytest.mark.parametrize(
    ("outcome", "said"),
    [
        ({"raised": "KeyError"}, " (it raises KeyError)"),
        ({"raised": "LinAlgError"}, " (it raises LinAlgError)"),
        ({"raised": "Secret"}, " (it raises an exception)"),
        ({"raised": 7}, " (it raises an exception)"),
        ({"unusable": "lazy"}, " (it returned a generator, of which nothing was computed yet; "
                               "make a list of it)"),
        ({"unusable": "3.75"}, " (it returned something that is not a number, text, list, "
                               "dictionary or array)"),
        ({"unusable": ["lazy"]}, " (it returned something that is not a number, text, list, "
                                 "dictionary or array)"),
        ({"value": 17.1, "changed": True}, " (it changes its input in place; work on a copy)"),
        ({"value": 5.0}, ""),
        ({}, ""),
        (None, ""),
        ("raised", ""),
        ("unusable", ""),
        ("changed", ""),
    ],
)  # fmt: skip
def test_what_happened_on_a_kind_of_input(outcome, said):
    outcomes = but(2, outcome)
    assert labels(mark(outcomes)) == [f"large{said}"]
    assert f"Not yet on: large{said}." in mark(outcomes).feedback
    # By itself a page of feedback would tell which inputs fail in which way.
    secret = mark(outcomes, tells=False)
    assert labels(secret) == ["large"]
    assert (NO_VALUE in secret.feedback) == (outcome != {"value": 5.0})
    assert NO_VALUE not in mark(outcomes).feedback


def test_of_a_kind_the_first_thing_that_happened_is_told():
    outcomes = [RIGHT[0], {"raised": "KeyError"}, *RIGHT[2:]]
    assert labels(mark(outcomes)) == ["small (it raises KeyError)"]
    outcomes = [{"unusable": "lazy"}, {"raised": "KeyError"}, *RIGHT[2:]]
    assert labels(mark(outcomes))[0].startswith("small (it returned a generator")


def test_where_no_value_came_is_said_of_what_is_wrong_alone():
    """An exception that was asked for is none that could tell anything."""
    asked = but(3, {"raised": "ValueError"})
    assert NO_VALUE not in mark(but(2, OFF[2], asked), right=asked, tells=False).feedback
    assert (
        NO_VALUE in mark(but(2, {"raised": "KeyError"}, asked), right=asked, tells=False).feedback
    )


@pytest.mark.parametrize("place", [0, 3])
def test_where_no_value_came_is_said_of_the_first_and_of_the_last(place):
    assert NO_VALUE in mark(but(place, {"raised": "KeyError"}), tells=False).feedback


def test_everything_may_be_told_where_all_is_public():
    public = [{**case, "public": True} for case in CASES]
    outcomes = but(2, {"raised": "KeyError"})
    assert labels(mark(outcomes, public, tells=False)) == ["large (it raises KeyError)"]
    for place in (0, 3):
        but_one = [{**case, "public": i != place} for i, case in enumerate(CASES)]
        assert labels(mark(outcomes, but_one, tells=False)) == ["large"]
    assert NO_VALUE not in mark(outcomes, public, tells=False).feedback


def test_an_exception_on_every_input_is_an_error_and_names_the_first():
    outcomes = [{"raised": name} for name in ("KeyError", "TypeError", "KeyError", "Secret")]
    verdict = mark(outcomes)
    assert (verdict.status, verdict.credit, verdict.max_points) == ("error", 0.0, 8.0)
    assert verdict.feedback == (
        "It raises KeyError on every input. Try it on a small example first."
    )
    assert (verdict.explanation, len(verdict.parts)) == ("why", 3)
    assert mark(outcomes, tells=False).feedback == (
        "It raises an exception on every input. Try it on a small example first."
    )
    for other in (None, RIGHT[3], {"unusable": "lazy"}, "raised"):
        for place in (0, 3):
            assert mark(but(place, other, outcomes)).status != "error"


def test_a_diagnosis_comes_first_and_takes_the_place_of_an_example():
    says = Says(Diagnosis("half", "It looks as if a half is missing.", "by a mutant"))
    outcomes = but(0, OFF[0], OFF)
    verdict = mark(outcomes, hypotheses=says)
    assert (verdict.status, verdict.alternative, verdict.evidence) == (
        "wrong",
        "half",
        "by a mutant",
    )
    assert verdict.feedback == (
        "It looks as if a half is missing. "
        "Right on 0 of 3 kinds of input. Not yet on: small; large; odd."
    )
    assert says.seen == [(RIGHT, outcomes, [False] * 4)]


def test_a_relation_between_values_is_simpler_than_any_hypothesis():
    says = Says(Diagnosis("half", "s"))
    verdict = mark([{"value": -entry["value"]} for entry in RIGHT], hypotheses=says)
    assert verdict.alternative == "sign turned"
    assert says.seen == []


def test_a_relation_holds_as_finely_as_the_question_measures():
    def a_little_less(case: Any, expected: Any, actual: Any) -> bool:
        return 0 <= case["args"][0] * (expected - actual) <= 1.0

    turned = [{"value": -entry["value"] - 0.001} for entry in RIGHT]
    assert mark(turned, compare=a_little_less).alternative == "sign turned"
    assert mark(turned).alternative is None
    turned = [{"value": -entry["value"] + 0.001} for entry in RIGHT]
    assert mark(turned, compare=a_little_less).alternative is None
    typed = [{"value": str(entry["value"] - 0.001)} for entry in RIGHT]
    assert mark(typed, compare=a_little_less).alternative == "a text for a number"
    assert mark(typed).alternative is None


def test_a_relation_between_numbers_holds_also_where_the_question_measures_something_else():
    def one_of_the_right_ones(case: Any, expected: Any, actual: Any) -> bool:
        return {"value": actual} in RIGHT and expected == actual

    turned = [{"value": -entry["value"]} for entry in RIGHT]
    assert mark(turned, compare=one_of_the_right_ones).alternative == "sign turned"


def test_a_diagnosis_that_fails_costs_no_mark():
    verdict = mark(OFF, hypotheses=Says(error=RuntimeError("anything may be in it")))
    assert (verdict.status, verdict.alternative) == ("wrong", None)
    assert verdict.evidence == fingerprint(OFF)


def test_what_has_no_name_shows_the_smallest_example_that_students_may_see():
    args = [[1.0, 2.0, 3.0], [np.zeros(2)], [[4.0], 5.0, 6.0, 7.0], [[[8.0]]]]
    cases = [{"name": f"kind {i}", "args": a, "public": i != 3} for i, a in enumerate(args)]
    said = mark(OFF, cases, RIGHT).feedback.partition(" For example: ")[2]
    assert said.startswith("f(np.array([0., 0.])) gives 3.1; expected is 2.9. f(1, 2, 3) gives")
    assert "f([4], 5, 6, 7) gives" in said
    assert "f([[8]])" not in said  # hidden
    said = mark(but(1, RIGHT[1], OFF), cases, RIGHT).feedback.partition(" For example: ")[2]
    assert said.startswith("f(1, 2, 3) gives 8.6; expected is 1.3.")


def test_an_array_is_as_large_as_it_has_numbers():
    args = [[np.zeros((2, 2))], [1.0, 2.0, 3.0], [[5.0, 6.0]], [[]]]
    cases = [{"name": f"kind {i}", "args": a, "public": True} for i, a in enumerate(args)]
    said = mark(OFF, cases, RIGHT).feedback.partition(" For example: ")[2]
    order = [said.find(call) for call in ("f([])", "f([5, 6])", "f(1, 2, 3)")]
    assert order == sorted(order)
    assert min(order) == 0


def test_a_page_of_feedback_shows_no_result_but_the_one_that_was_asked_for_alone():
    cases = [{**case, "public": True} for case in CASES[:3]] + [CASES[3]]
    for picture in (None, "m:p"):
        feedback = mark(OFF, cases, picture=picture, tells=False).feedback
        assert ("f(2) gives 8.6; expected is 1.3." in feedback) == (picture is not None)
        assert "f(300)" not in feedback
    assert "f(2) gives 8.6;" in mark(OFF, picture="m:p", tells=False).feedback
    later = mark(but(0, RIGHT[0], OFF), cases, picture="m:p", tells=False)
    assert "For example" not in later.feedback
    hidden = [{**case, "public": False} for case in CASES]
    assert "For example" not in mark(OFF, hidden).feedback


def test_an_example_that_cannot_be_shown_need_not_be():
    class Odd(float):
        def __format__(self, spec: str) -> str:
            raise RuntimeError

    cases = [{**CASES[0], "args": [Odd(2.0)]}, *CASES[1:]]
    verdict = mark(OFF, cases)
    assert verdict.status == "wrong"
    assert "For example" not in verdict.feedback


def test_nameless_responses_of_one_kind_have_one_word_in_common():
    assert mark(OFF).evidence == fingerprint(OFF)
    assert fingerprint(OFF).startswith("outcomes ")
    assert len(fingerprint(OFF)) == len("outcomes 01234567")
    near = [{"value": entry["value"] * (1 + 1e-9)} for entry in OFF]
    assert fingerprint(near) == fingerprint(OFF)
    # Marks that were given keep their word: the CRC-32 of "[value:0.333333,]".
    assert fingerprint([{"value": 1 / 3}]) == "outcomes 06b949a7"
    same = [
        ([0.0], [-0.0]),
        ([1], [1.0]),
        ([np.array([1.0, 2.5])], [[1.0, 2.5]]),
        ({"a": 1, "b": 2}, {"b": 2, "a": 1}),
        (["x" * 79 + "1"], ["x" * 79 + "2"]),  # no longer than a table can show
    ]
    for one, other in same:
        assert fingerprint(one) == fingerprint(other)
    different = [[1.0], [1.001], [[1.0]], [1.0, 1.0], {"a": 1.0}, {"b": 1.0}, ["1"], [None], ["x"]]
    assert len({fingerprint(entry) for entry in different}) == len(different)
    assert fingerprint(["x" * 78 + "1"]) != fingerprint(["x" * 78 + "2"])


def test_what_was_changed_or_drawn_has_to_be_as_in_the_right_outcome():
    assert agrees(close, {}, {"value": 1.0, "changed": True}, {"value": 1.0, "changed": True})
    assert not agrees(close, {}, {"value": 1.0, "changed": True}, {"value": 1.0})
    case = {"draws": (3, 5)}
    for drawn, fits in ((2, False), (3, True), (5, True), (6, False), (True, False)):
        assert (
            agrees(close, case, {"value": 1.0, "drawn": 4}, {"value": 1.0, "drawn": drawn}) == fits
        )
    drawn = {"value": 1.0, "drawn": 1}
    assert not agrees(close, {"draws": (0, 5)}, drawn, {"value": 1.0, "drawn": True})
    # A mistake that draws otherwise than its case says is met by what does the same.
    too_many = {"value": 1.0, "drawn": 9}
    assert agrees(close, case, too_many, {"value": 1.0, "drawn": 7})
    assert not agrees(close, case, too_many, {"value": 1.0, "drawn": 2})


def test_an_exception_that_may_be_raised_is_the_one_that_is_named_or_a_more_special_one():
    case, expected = {"may_raise": "ValueError"}, {"value": np.inf}
    for given, fits in (("ValueError", True), ("LinAlgError", True), ("Exception", False)):
        assert agrees(close, case, expected, {"raised": given}) is fits


def test_the_right_value_comes_first_and_what_cannot_be_compared_is_not_equal():
    def at_most(case: Any, expected: Any, actual: Any) -> bool:
        return bool(actual <= expected)

    assert agrees(at_most, {}, {"value": 3.0}, {"value": 2.0})
    assert not agrees(at_most, {}, {"value": 2.0}, {"value": 3.0})
    for value in ("3", None, [1.0], 1j):
        assert agrees(at_most, {}, {"value": 3.0}, {"value": value}) is False


def test_whether_an_outcome_agrees_is_a_plain_truth_value():
    def compare(case: Any, expected: Any, actual: Any) -> Any:
        return np.bool_(expected == actual)

    for value, fits in ((1.0, True), (2.0, False)):
        assert agrees(compare, {}, {"value": 1.0}, {"value": value}) is fits
    assert agrees(close, {}, {"unusable": "lazy"}, {"unusable": "lazy"}) is True
    assert agrees(close, {}, {"unusable": "lazy"}, {"unusable": "text"}) is False


def test_exceptions_are_compared_by_their_classes_where_these_are_known():
    for right, given, fits in (
        ("LinAlgError", "LinAlgError", True),
        ("ValueError", "LinAlgError", True),
        ("Exception", "LinAlgError", True),
        ("TypeError", "LinAlgError", False),
        ("LinAlgError", "ValueError", False),
        ("LookupError", "KeyError", True),
        ("KeyError", "LookupError", False),
        ("NoPath", "NoPath", True),  # of the course
        ("NoPath", "ValueError", False),
        ("ValueError", "NoPath", False),
        ("print", "ValueError", False),
        ("print", "print", True),
    ):
        assert agrees(close, {}, {"raised": right}, {"raised": given}) == fits, (right, given)
    assert not agrees(close, {}, {"raised": "ValueError"}, {"raised": 7})
    assert not agrees(close, {}, {"raised": "ValueError"}, {"raised": "ValueError", "value": 1})
    assert not agrees(close, {}, {"raised": 7}, {"raised": "ValueError"})


@pytest.mark.parametrize(
    ("expected", "actual", "agree"),
    [
        (1.0, 1.0 + 0.9e-6, True),
        (1.0, 1.0 + 1.2e-6, False),
        (0.0, 0.9e-12, True),
        (0.0, 1.2e-12, False),
        ([1000.0, 0.0], [1000.0, 0.9e-6], True),
        ([1000.0, 0.0], [1000.0, 1.2e-6], False),
        ([-1000.0, 0.0], [-1000.0, 0.9e-6], True),
        ([np.inf, 0.0], [np.inf, 0.9e-12], True),
        ([np.inf, 0.0], [np.inf, 1.0], False),
        ([np.nan, 1.0], [np.nan, 1.0], True),
        (5, 5.0 + 0.9e-6, True),
        (5, 5.0 + 1.2e-6, False),
        ([5, 6], [5.0, 6.0 + 1.2e-6], False),
        (True, np.array(True), False),
        ([True, False], [1, 0], True),  # as arrays have them
        ([True, False], [1.0, 0.0], True),
        ([1.0, 2.0], [True, False], False),
        ([1.0 + 1e-9, 2.0], [1, 2], True),
        (1.0 + 1e-9, 1, True),
        ({"a": True}, {"a": np.array(True)}, False),
        (["x", True], ["x", np.array(True)], False),
        (["x", 1.0], ["y", 1.0], False),
        (10**400, 1.0, False),
        (1.0, 10**400, False),
        (float(2**70), 2**70, True),
        (2**63, float(2**63), True),
        (2**62 + 2**40, float(2**62), False),
        (2**63 + 2**40, float(2**63), True),  # longer than any integer of NumPy's
        (["a"], ["a", "b"], False),
        (["a", "b"], ["a"], False),
        (["a"], "a", False),
        ({"a": 1.0}, {"a": 2.0}, False),
        ({"a": 1.0}, {"b": 1.0}, False),
        (np.array(["a"]), np.array(["a"]), False),
        (None, 0, False),
    ],
)  # fmt: skip
def test_the_default_comparison_at_its_limits(expected, actual, agree):
    assert close({}, expected, actual) is agree


@pytest.mark.parametrize(
    ("expected", "actual", "agree"),
    [
        (1.0, 1.0 + 0.9e-5, True),
        (1.0, 1.0 + 1.2e-5, False),
        (0.0, 0.9e-9, True),
        (0.0, 1.2e-9, False),
        ({"a": [0.0, 1000.0]}, {"a": [0.9e-3, 1000.0]}, True),
        ({"a": [0.0, 1000.0]}, {"a": [1.2e-3, 1000.0]}, False),
        (["x", 1.0], ["x", 1.0 + 0.9e-5], True),
        (["x", 1.0], ["x", 1.0 + 1.2e-5], False),
        (["x", [0.0, 1000.0]], ["x", [0.9e-3, 1000.0]], True),
        (["x", [0.0, 1000.0]], ["x", [1.2e-3, 1000.0]], False),
        (True, np.array(True), False),
    ],
)  # fmt: skip
def test_what_went_through_single_precision_is_compared_less_finely(expected, actual, agree):
    assert nearly({}, expected, actual) is agree


@pytest.mark.parametrize(
    ("asked", "outcome", "said"),
    [
        ({"draws": (4, 4)}, {"drawn": 8}, 'draws 8 random numbers, and "draws" asks for 4'),
        ({"draws": (3, 3)}, {"drawn": 0}, "asks for 3; only those of the generator it is given"),
        ({"samples": (3, 5, 5)}, {"sampled": [2, 5]}, 'of 2, and "samples" counts those of 3'),
        ({"samples": (2, 5, 5)}, {"sampled": [2, 4]}, 'draws 4 samples, and "samples" asks for 5'),
        ({"draws": (4, 8), "samples": (2, 4, 4)}, {"drawn": 8, "sampled": [2, 4]}, ""),
        ({"samples": (2, 4, 4)}, {"drawn": 8}, ""),  # drawn in another way
    ],
)
def test_a_reference_draws_what_its_cases_ask_for(asked, outcome, said):
    """Marking compares with the reference: where that draws otherwise, nobody's draws count."""
    case = {"name": "many", "args": [{"rng": 1}], **asked}
    expected = Expected([case, case], [{"value": 1.0, **outcome}] * 2, close, [])
    found = list(other_counts(expected))
    assert len(found) == bool(said)
    assert all("for the case 'many' the reference" in line and said in line for line in found)


def test_a_generator_is_shown_as_it_can_be_typed():
    """Not as the case has it: a student who types that into a cell gets an exception."""
    cases = [{"name": "three", "args": [2.0, {"rng": 7}], "public": True}]
    said = hints(QUESTION, cases, [{"value": 1.0}], [{"value": 3.0}], [0])
    assert said == "f(2, np.random.default_rng(7)) gives 3; expected is 1."


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"samples": (5, 5)}, '"samples" must be (2, low, high) for samples of two, not (5, 5)'),
        ({"samples": 5}, '"samples" must be'),
        ({"draws": (2, 3, 4)}, '"draws" must be (low, high), not (2, 3, 4)'),
        ({"draws": ("3", "3")}, '"draws" must be'),
    ],
)
def test_counts_of_another_shape_are_refused(asked, said):
    cases = [{"name": "a", "args": [], "draws": (1, float("inf"))}, {"name": "b", "args": []}]
    assert problem_of_cases(QUESTION, cases) == ""
    refused = problem_of_cases(QUESTION, [cases[0], cases[1] | asked])
    assert f"Case 'b' of Q9: {said}" in refused
