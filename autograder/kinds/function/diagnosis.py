"""A name for a wrong function that no mistake of the key has, by what it returns.

A relation is accepted only if it explains the value of every case that has a right value, and if
at least two of these are wrong. Nothing of a student's is run for it.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from autograder.marking.diagnosis.relations import RELATIONS, Diagnosis

MOST_SECONDS = 0.1  # of a processor, for one response
_FEWEST = 2  # wrong cases that a relation has to explain
_PLACES = ("first", "second", "third", "fourth")
Same = Callable[[Mapping[str, Any], Any, Any], bool]
Change = Callable[[Mapping[str, Any], Any], Any]


class _NotForThis(Exception):
    """A change has no meaning for a value."""


def diagnose_function(
    cases: Sequence[Mapping[str, Any]],
    right: Sequence[Mapping[str, Any]],
    outcomes: Sequence[Any],
    verdicts: Sequence[bool],
    same: Same,
) -> Diagnosis | None:
    """The simplest relation between right values and those returned, or None.

    ``same`` tells whether the second of two values counts as the first for a case.
    """
    end = time.process_time() + MOST_SECONDS
    asked = [i for i, outcome in enumerate(right) if "value" in outcome]
    wrong = [i for i in asked if not verdicts[i]]
    given = [outcomes[i] for i in asked]
    if len(wrong) < _FEWEST or not all(isinstance(o, dict) and "value" in o for o in given):
        return None
    # The wrong ones first: a relation that does not hold is soon refuted.
    order = [*wrong, *(i for i in asked if verdicts[i])]
    if all(_explains(_itself, cases[i], right[i], outcomes[i], same) for i in asked):
        return _right_but(cases, outcomes, wrong)
    for diagnosis, change in _changes(cases, right, asked):
        if time.process_time() > end:
            return None
        if all(_explains(change, cases[i], right[i], outcomes[i], same) for i in order):
            return diagnosis
    return None


def _right_but(
    cases: Sequence[Mapping[str, Any]], outcomes: Sequence[Any], wrong: Sequence[int]
) -> Diagnosis | None:
    """Why right values are wrong all the same."""
    if all("changed" in outcomes[i] for i in wrong):
        return Diagnosis(
            "changes its input",
            "It looks as if the values are right, but the input is changed in place: use a copy.",
        )
    if all("draws" in cases[i] and "changed" not in outcomes[i] for i in wrong):
        return Diagnosis(
            "other number of draws",
            "It looks as if the number of random draws is not the one asked for, or comes from "
            "another generator than the argument.",
        )
    return None


def _explains(
    change: Change,
    case: Mapping[str, Any],
    right: Mapping[str, Any],
    outcome: Mapping[str, Any],
    same: Same,
) -> bool:
    try:
        with np.errstate(all="ignore"):
            return bool(same(case, change(case, right["value"]), outcome["value"]))
    except Exception:
        # What cannot be changed so, or compared with what came, is not explained by it.
        return False


def _changes(
    cases: Sequence[Mapping[str, Any]], right: Sequence[Mapping[str, Any]], asked: Sequence[int]
) -> Iterator[tuple[Diagnosis, Change]]:
    """Every relation, the simpler ones first."""

    def told(name: str, sentence: str) -> Diagnosis:
        return Diagnosis(name, f"It looks as if {sentence}.")

    yield (
        told("returns nothing", "the result is printed or kept, but never returned: add a return"),
        lambda _, value: None,
    )
    first = right[asked[0]]["value"]
    yield (
        told("always the same", "the first example's result is written in, whatever the input"),
        lambda _, value: first,
    )
    for place in range(max((len(cases[i]["args"]) for i in asked), default=0)):
        yield told("returns its input", "an input is returned as it came"), _argument(place)
    for name, sentence, change in (
        ("other order", "two results are returned in the other order", _exchanged),
        ("reversed", "the results stand in reverse order", _on_array(lambda x: x[::-1])),
        ("sorted", "the results were sorted", _on_array(lambda x: np.sort(x, axis=0))),
        ("transposed", "rows and columns have changed places", _on_array(_transposed)),
        ("only the first", "only the first of the results is returned", _first),
    ):
        yield told(name, sentence), change
    for relation in RELATIONS:
        diagnosis = Diagnosis(relation.name, relation.sentence)
        yield diagnosis, _on_array(relation.change)
    yield (
        told("a sum for a mean", "a sum stands for a mean: divide by the number"),
        lambda case, value: _on_array(lambda x: x * _size(case))(case, value),
    )
    yield (
        told("a mean for a sum", "a mean stands for a sum: do not divide by the number"),
        lambda case, value: _on_array(lambda x: x / _size(case))(case, value),
    )
    yield (
        told("N - 1 for N", "it was divided by N - 1 and not by N"),
        lambda case, value: _on_array(lambda x: x * _size(case) / (_size(case) - 1))(case, value),
    )
    for place, word in enumerate(_PLACES):
        for relation in RELATIONS:
            yield (
                Diagnosis(
                    f"{relation.name} ({word} result)",
                    f"{relation.sentence[:-1]} (in the {word} result).",
                ),
                _at(place, _on_array(relation.change)),
            )
        yield (
            told(f"mask for indices ({word} result)", f"the {word} result is a mask, not indices"),
            _at(place, _mask),
        )
        yield (
            told(
                f"points for indices ({word} result)",
                f"the {word} result holds the entries themselves, not their indices",
            ),
            _at(place, lambda case, value: case["args"][0][np.asarray(value, dtype=int)]),
        )
    yield told("mask for indices", "the result is a mask, not indices"), _mask


def _itself(_: Mapping[str, Any], value: Any) -> Any:
    return value


def _argument(place: int) -> Change:
    return lambda case, _: case["args"][place]


def _on_array(change: Callable[[Any], Any]) -> Change:
    def changed(_: Mapping[str, Any], value: Any) -> Any:
        array = np.asarray(value)
        if array.dtype.kind not in "iufb":
            raise _NotForThis
        found = change(array.astype(float) if array.dtype.kind == "b" else array)
        return found if isinstance(value, np.ndarray) else np.asarray(found).tolist()

    return changed


def _at(place: int, change: Change) -> Change:
    """A change of one of several results."""

    def changed(case: Mapping[str, Any], value: Any) -> Any:
        if not (isinstance(value, list) and place < len(value) <= len(_PLACES)):
            raise _NotForThis
        return [*value[:place], change(case, value[place]), *value[place + 1 :]]

    return changed


def _exchanged(_: Mapping[str, Any], value: Any) -> Any:
    if not (isinstance(value, list) and len(value) == 2):
        raise _NotForThis
    return value[::-1]


def _transposed(value: Any) -> Any:
    if value.ndim != 2:
        raise _NotForThis
    return value.T


def _first(_: Mapping[str, Any], value: Any) -> Any:
    return value[0]


def _mask(case: Mapping[str, Any], value: Any) -> Any:
    mask = np.zeros(_size(case), dtype=bool)
    mask[np.asarray(value, dtype=int)] = True
    return mask


def _size(case: Mapping[str, Any]) -> int:
    return len(case["args"][0])
