"""How far off a result may be before a check in a bundle may call it wrong.

A key's comparison may forgive more than a check knows: an order, a sign, a small difference. Here
it is tried out, when the snapshot is taken, whether it refuses every result in which one number is
off by a hundredth, and every list with one entry more or less. If so, a result that is off by more
than that, in whatever order its whole numbers stand, is wrong and need not be left open.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import partial

import numpy as np

from autograder.exchange.messages import Value
from autograder.kinds.function.marking import Expected, agrees

FAR = 0.01  # of the largest number beside it
_MOST = 2000  # changes that are tried
_TURNS = (math.pi, 2 * math.pi, math.pi / 2)  # an angle may be taken in more than one turn


def far_off(expected: Expected, index: int) -> float | None:
    """The share beyond which a number is certainly wrong; None if that is not known."""
    outcome = expected.outcomes[index]
    if "value" not in outcome:
        return None
    tried = 0
    for other in (*_turned(outcome["value"]), *_others(outcome["value"])):
        tried += 1
        if tried > _MOST or agrees(
            expected.compare, expected.cases[index], outcome, {**outcome, "value": other}
        ):
            return None
    return FAR if tried else None


def is_far(far: float, expected: Value, actual: Value) -> bool:
    """Whether a result is off by more than a share, in any order of its whole numbers."""
    if isinstance(expected, list) and not _numeric(expected):
        return not (
            isinstance(actual, list)
            and len(actual) == len(expected)
            and not any(is_far(far, e, a) for e, a in zip(expected, actual, strict=True))
        )
    if not (_numeric(expected) and _numeric(actual)):
        return False  # what it is will be said in another way
    right, given = np.asarray(expected), np.asarray(actual)
    if right.shape != given.shape:
        return True
    if right.dtype.kind in "iu":
        return not np.array_equal(np.sort(right, axis=None), np.sort(given, axis=None))
    size = float(np.max(np.abs(right), initial=0.0)) or 1.0
    return not bool(np.all(np.abs(given - right) <= far * size))


def _turned(value: Value) -> Iterator[Value]:
    """A value with its numbers turned round, or by a full turn, as lines and angles may be."""
    floats: list[bool] = []

    def changed(array: np.ndarray, by: Callable[[np.ndarray], np.ndarray]) -> np.ndarray:
        is_float = array.dtype.kind == "f" and bool(array.any())
        floats.append(is_float)
        return by(array) if is_float else array

    for by in (np.negative, lambda array: array + 2 * math.pi):
        turned = changed_throughout(value, partial(changed, by=by))
        if any(floats):
            yield turned


def changed_throughout(value: object, change: Callable[[np.ndarray], np.ndarray]) -> object:
    """A value with every array and every list of numbers in it changed."""
    try:
        array = np.asarray(value)
    except ValueError:  # lists of unequal length
        array = np.asarray(None)
    if array.dtype.kind in "iuf":
        changed = change(array)
        return changed if isinstance(value, np.ndarray) else changed.tolist()
    return (
        [changed_throughout(entry, change) for entry in value] if isinstance(value, list) else value
    )


def _others(value: Value) -> Iterator[Value]:
    """A value with one thing in it changed, one after the other."""
    if isinstance(value, list) and not _numeric(value):
        for place, entry in enumerate(value):
            for other in _others(entry):
                yield [*value[:place], other, *value[place + 1 :]]
        return
    if not _numeric(value):
        return
    array = np.asarray(value)

    def like(changed: np.ndarray) -> Value:
        return changed if isinstance(value, np.ndarray) else changed.tolist()

    if array.ndim == 1 and isinstance(value, list | np.ndarray):
        yield like(array[:-1]) if array.size else [0]
        yield like(np.append(array, array[-1:])) if array.size else [0, 0]
    if not np.isfinite(array).all():
        return
    size = float(np.max(np.abs(array), initial=0.0)) or 1.0
    steps = (1, -1) if array.dtype.kind in "iu" else (FAR * size, -FAR * size, *_TURNS)
    for position in np.ndindex(array.shape):
        for step in steps:
            changed = array.copy()
            changed[position] += step
            yield like(changed)
    if array.dtype.kind == "f" and array.any():
        yield like(-array)


def _numeric(value: object) -> bool:
    try:
        return np.asarray(value).dtype.kind in "iuf"
    except (ValueError, OverflowError):
        return False
