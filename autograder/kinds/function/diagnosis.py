"""A name for a wrong function that no mistake of the key has, by what it returns.

A relation is accepted only if it explains the value of every case that has a right value, and if
at least two of these are wrong. Nothing of a student's is run for it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from autograder.diagnosis.effort import Effort, numbers_in
from autograder.diagnosis.relations import Diagnosis, looks_as_if
from autograder.exchange.messages import Value, Values
from autograder.kinds.function.changed_values import Change, changes
from autograder.kinds.function.draws import drew
from autograder.kinds.function.right_but_for_form import Repair, repairs
from autograder.language import _

_MOST_STEPS = 1_000_000  # for one response, some 0.1 s of a processor
_A_COMPARISON = 50
_FEWEST = 2  # wrong cases that a relation has to explain
_TELLING_NUMBERS = 6  # different ones, for a line through them to say anything
Same = Callable[[Mapping[str, object], object, object], bool]


def diagnose_function(
    cases: Sequence[Values],
    right: Sequence[Values],
    outcomes: Sequence[Value],
    verdicts: Sequence[bool],
    same: Same,
    counts_as_right: Same | None = None,
) -> Diagnosis | None:
    """The simplest relation between right values and those returned, or None.

    ``same`` tells whether the second of two values counts as the first for a case, and
    ``counts_as_right`` the same by the question's own measure alone.
    """
    asked = [i for i, outcome in enumerate(right) if "value" in outcome]
    wrong = [i for i in asked if not verdicts[i]]
    if found := _never_a_value(outcomes, wrong):
        return found
    if any(not (isinstance(outcomes[i], dict) and "value" in outcomes[i]) for i in wrong):
        return None
    if _nothing_for_an_empty_case(right, outcomes, verdicts, wrong):
        return Diagnosis(
            "an empty case",
            looks_as_if(_("only the empty case is wrong: it asks for an empty result, too")),
        )
    if len(wrong) < _FEWEST:
        return None
    # Somebody who treats what is empty apart, or has nothing to change there, is right there.
    telling = [i for i in asked if not (verdicts[i] and _is_empty(right[i]["value"]))]
    # The wrong ones first: a relation that does not hold is soon refuted.
    order = [*wrong, *(i for i in telling if verdicts[i])]
    if any(not (isinstance(outcomes[i], dict) and "value" in outcomes[i]) for i in order):
        return None  # an exception that counts as right
    is_equal = all(_explains(_itself, cases[i], right[i], outcomes[i], same) for i in asked)
    if is_equal and (found := _right_but(cases, outcomes, wrong)):
        return found
    costs = {i: _A_COMPARISON + numbers_in(outcomes[i]) for i in asked}
    effort = Effort(_MOST_STEPS)
    for diagnosis, change in () if is_equal else changes(cases, right, asked):
        for i in order:
            if not effort.spend(costs[i]):
                return None
            if not _explains(change, cases[i], right[i], outcomes[i], same):
                break
        else:
            return diagnosis
    for name, words, repair in repairs():
        for i in wrong:
            if not effort.spend(costs[i]):
                return None
            if not _is_mended(repair, cases[i], right[i], outcomes[i], counts_as_right or same):
                break
        else:
            return Diagnosis(name, looks_as_if(words))
    return _linear(right, outcomes, order)


def _never_a_value(outcomes: Sequence[Value], wrong: Sequence[int]) -> Diagnosis | None:
    """Something that is made when it is asked for, in place of what was asked for."""
    reasons = [outcomes[i].get("unusable") for i in wrong if isinstance(outcomes[i], dict)]
    lazy = [reason for reason in reasons if isinstance(reason, str) and reason == "lazy"]
    if len(wrong) >= _FEWEST and len(lazy) == len(wrong):
        return Diagnosis(
            "a generator",
            looks_as_if(
                _(
                    "a generator is returned and nothing was computed yet: make a list or an "
                    "array of it"
                )
            ),
        )
    return None


def _nothing_for_an_empty_case(
    right: Sequence[Values],
    outcomes: Sequence[Value],
    verdicts: Sequence[bool],
    wrong: Sequence[int],
) -> bool:
    """Whether all is right but what has nothing to be computed from."""
    if not wrong or sum(verdicts) < len(verdicts) - len(wrong) or sum(verdicts) < _FEWEST:
        return False
    return all(
        _is_empty(right[i]["value"]) and not outcomes[i].get("changed")
        and (outcomes[i]["value"] is None or _is_empty(outcomes[i]["value"]))
        for i in wrong
    )  # fmt: skip


def _is_empty(value: Value) -> bool:
    if isinstance(value, np.ndarray):
        return value.size == 0
    return isinstance(value, list) and len(value) == 0


def _is_mended(
    repair: Repair,
    case: Values,
    right: Values,
    outcome: Values,
    same: Same,
) -> bool:
    if "changed" in outcome:
        return False
    try:
        with np.errstate(all="ignore"):
            return bool(same(case, right["value"], repair(case, right["value"], outcome["value"])))
    except Exception:
        # What cannot be repaired so is not mended by it.
        return False


def _linear(
    right: Sequence[Values],
    outcomes: Sequence[Value],
    order: Sequence[int],
) -> Diagnosis | None:
    """All numbers are the right ones times a constant, plus another."""
    given, wanted = [], []
    for i in order:
        one, other = _flat(outcomes[i]["value"]), _flat(right[i]["value"])
        if one is None or other is None or len(one) != len(other):
            return None
        given.append(one)
        wanted.append(other)
    y, x = np.concatenate(given), np.concatenate(wanted)
    if len(np.unique(x)) < _TELLING_NUMBERS or np.ptp(x) == 0 or not np.isfinite(y).all():
        return None
    if not np.isfinite(x).all():
        return None
    factor, offset = np.polyfit(x, y, 1)
    if np.any(np.abs(factor * x + offset - y) > 1e-7 * np.maximum(np.abs(y), 1e-3)):
        return None
    if abs(factor) < 1e-6 or (abs(factor - 1) < 1e-6 and abs(offset) < 1e-9):
        return None
    evidence = f"{factor:.6g} times the right value, plus {offset:.6g}"
    if abs(offset) < 1e-9 * np.abs(y).max():
        return Diagnosis(
            "a constant factor",
            looks_as_if(_("only a constant factor is wrong: the form is right")),
            evidence,
        )
    if abs(factor + 1) < 1e-6:
        return Diagnosis(
            "counted from the other end",
            looks_as_if(
                _(
                    "the result is counted from the other end: what should be large is small, and "
                    "the other way round"
                )
            ),
            evidence,
        )
    if abs(factor - 1) < 1e-6:
        return Diagnosis(
            "a constant more",
            looks_as_if(_("a constant was added that is not asked for, or left out")),
            evidence,
        )
    return None


def _flat(value: Value) -> np.ndarray | None:
    try:
        array = np.asarray(value)
    except ValueError:
        return None
    return array.astype(float).ravel() if array.dtype.kind in "iuf" else None


def _right_but(
    cases: Sequence[Values], outcomes: Sequence[Value], wrong: Sequence[int]
) -> Diagnosis | None:
    """Why right values are wrong all the same."""
    if all("changed" in outcomes[i] for i in wrong):
        return Diagnosis(
            "changes its input",
            looks_as_if(_("the values are right, but the input is changed in place: use a copy")),
        )
    if all(drew(cases[i], outcomes[i]) and "changed" not in outcomes[i] for i in wrong):
        return Diagnosis(
            "other number of draws",
            looks_as_if(
                _(
                    "the number of random draws is not the one asked for, or comes from another "
                    "generator than the argument"
                )
            ),
        )
    return None


def _explains(
    change: Change,
    case: Values,
    right: Values,
    outcome: Values,
    same: Same,
) -> bool:
    try:
        with np.errstate(all="ignore"):
            return bool(same(case, change(case, right["value"]), outcome["value"]))
    except Exception:
        # What cannot be changed so, or compared with what came, is not explained by it.
        return False


def _itself(_: Values, value: Value) -> object:
    return value
