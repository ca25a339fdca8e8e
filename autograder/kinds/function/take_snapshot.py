"""Takes the snapshot of a function question: examples with their right outcomes.

Taken are the public cases, and for each known mistake that they do not tell from the right response
one more case that does. Such a case is drawn at random for the snapshot alone, so it is none of the
inputs that grade; a hidden case that is the same in every draw is never used.

A check in the bundle compares numbers and has no other code. Where the key's own comparison
forgives more (indices in any order, a normal turned round), the snapshot says so and holds what the
known mistakes give: what equals one of those is wrong, and any other difference is left open. Where
it also takes what was computed with single precision on the way, as by OpenCV, so does the check.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from autograder.exchange.messages import Value
from autograder.kinds.function.answer import FunctionAnswer
from autograder.kinds.function.marking import Expected, agrees, close
from autograder.kinds.pack import pack


def take_snapshot(
    answer: FunctionAnswer, drawn: Expected, again: Expected
) -> tuple[dict[str, Value], list[str]]:
    """The cases that students may see, and the mistakes that they do not tell apart.

    ``again`` is another draw: a hidden case that stands in both is never used.
    """
    chosen = [index for index, case in enumerate(drawn.cases) if case.get("public")]
    missed = []
    for mistake, outcomes in drawn.mistakes:
        if any(_differs(drawn, index, outcomes) for index in chosen):
            continue
        telling = [
            index
            for index, case in enumerate(drawn.cases)
            if not _is_fixed(case, again.cases) and _differs(drawn, index, outcomes)
        ]
        if telling:
            chosen.append(telling[0])
        else:
            missed.append(mistake.name)
    if not chosen:  # at least something to call a stub with
        chosen = [i for i, case in enumerate(drawn.cases) if not _is_fixed(case, again.cases)][:1]
    forgiving = any(forgives(drawn, index) for index in chosen)
    cases = []
    for index in sorted(chosen):
        case = {k: v for k, v in drawn.cases[index].items() if k != "public"}
        case.setdefault("kwargs", {})
        if answer.snapshot:
            case["expected"] = drawn.outcomes[index]
            if forgiving:
                case["wrong"] = [
                    outcomes[index]
                    for _, outcomes in drawn.mistakes
                    if _differs(drawn, index, outcomes)
                ]
        cases.append(case)
    checked = answer.snapshot and bool(cases)
    near = forgiving and all(takes_single_precision(drawn, index) for index in chosen)
    return {"checked": checked, "forgiving": forgiving, "near": near, "cases": cases}, missed


def takes_single_precision(expected: Expected, index: int) -> bool:
    """Whether the key's comparison takes the right outcome with the error of single precision."""
    outcome = expected.outcomes[index]
    if "value" not in outcome:
        return True
    value = _changed(
        outcome["value"],
        lambda array: array * (1 + 1e-5) if array.dtype.kind == "f" else array,
    )
    return agrees(expected.compare, expected.cases[index], outcome, {**outcome, "value": value})


def forgives(expected: Expected, index: int) -> bool:
    """Whether the key's comparison takes more than equal numbers for the right outcome of a case.

    Tried out with the right outcome in another order, turned round, turned by a full turn, and
    changed a little.
    """
    outcome = expected.outcomes[index]
    if "value" not in outcome:
        return False
    return any(
        not agrees(close, expected.cases[index], outcome, {**outcome, "value": variant})
        and agrees(expected.compare, expected.cases[index], outcome, {**outcome, "value": variant})
        for variant in _variants(outcome["value"])
    )


def _variants(value: object) -> Iterator[object]:
    for change in (
        lambda array: array[::-1] if array.ndim else array,
        lambda array: -array if array.dtype.kind == "f" else array,
        lambda array: array + 2 * np.pi if array.dtype.kind == "f" else array,
        lambda array: array * (1 + 1e-4) if array.dtype.kind == "f" else array,
    ):
        yield _changed(value, change)
        if isinstance(value, list):
            for position, entry in enumerate(value):
                yield [*value[:position], _changed(entry, change), *value[position + 1 :]]


def _changed(value: object, change: Callable[[np.ndarray], np.ndarray]) -> object:
    """A value with every array and every list of numbers in it changed."""
    try:
        array = np.asarray(value)
    except ValueError:  # lists of unequal length
        array = np.asarray(None)
    if array.dtype.kind in "iuf":
        changed = change(array)
        return changed if isinstance(value, np.ndarray) else changed.tolist()
    return [_changed(entry, change) for entry in value] if isinstance(value, list) else value


def _differs(expected: Expected, index: int, outcomes: Sequence[object]) -> bool:
    """Whether a check that only compares numbers sees a mistake in a case."""
    return not agrees(close, expected.cases[index], expected.outcomes[index], outcomes[index])


def _is_fixed(case: dict[str, object], others: Sequence[dict[str, object]]) -> bool:
    """Whether a case stands with the very same inputs in another draw."""
    return any(
        close({}, pack(case["args"]), pack(other["args"]))
        and close({}, pack(case.get("kwargs", {})), pack(other.get("kwargs", {})))
        for other in others
    )
