"""What a right value becomes if one simple thing was done wrong with it, for any function.

Each change has the name and the sentence that a student whose values it explains is told.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from autograder.diagnosis.relations import RELATIONS, Diagnosis, looks_as_if
from autograder.exchange.messages import Value, Values
from autograder.kinds.function.right_but_for_form import PLACES
from autograder.language import N_, _, n_

Change = Callable[[Values, Value], Value]  # of a case's right value


class _NotForThis(Exception):
    """A change has no meaning for a value."""


def changes(
    cases: Sequence[Values], right: Sequence[Values], asked: Sequence[int]
) -> Iterator[tuple[Diagnosis, Change]]:
    """Every relation, the simpler ones first."""

    def told(name: str, said: str, **fields: object) -> Diagnosis:
        return Diagnosis(name, looks_as_if(_(said).format(**fields)))

    yield (
        told(
            "returns nothing",
            N_("nothing is returned: return what is printed or kept in a variable"),
        ),
        lambda _, value: None,
    )
    first = right[asked[0]]["value"]
    yield (
        told("always the same", N_("the first example's result is written in, whatever the input")),
        lambda _, value: first,
    )
    for place in range(max((len(cases[i]["args"]) for i in asked), default=0)):
        yield told("returns its input", N_("an input is returned as it came")), _argument(place)
    for name, sentence, change in (
        ("other order", N_("two results are returned in the other order"), _exchanged),
        ("reversed", N_("the results stand in reverse order"), _on_array(lambda x: x[::-1])),
        ("sorted", N_("the results were sorted"), _on_array(lambda x: np.sort(x, axis=0))),
        ("transposed", N_("rows and columns have changed places"), _on_array(_transposed)),
        ("only the first", N_("only the first of the results is returned"), _first),
        ("only the first", N_("only the first of the results is returned"), lambda _, v: v[:1]),
        ("only the last", N_("only the last of the results is returned"), lambda _, v: v[-1]),
        ("one too few", N_("the last of the results is missing"), lambda _, v: v[:-1]),
        ("first left out", N_("the first of the results is missing"), lambda _, v: v[1:]),
        ("one too many", N_("there is one entry too many at the end"), _on_array(_one_more_entry)),
        ("sorted downwards", N_("the results were sorted"), _on_array(_sorted_down)),
        ("both axes reversed", N_("both axes are in the other order"), _on_array(_turned)),
        ("only the diagonal", N_("only the diagonal is returned"), _on_array(_diagonal)),
        ("off the diagonal", N_("everything off the diagonal is zero"), _on_array(_only_diagonal)),
        ("the largest", N_("only the largest of the results is returned"), _on_array(np.max)),
        ("the smallest", N_("only the smallest of the results is returned"), _on_array(np.min)),
        (
            "where the largest is",
            N_("it is returned where the largest result is, and not the results"),
            _on_array(np.argmax),
        ),
        (
            "where the smallest is",
            N_("it is returned where the smallest result is, and not the results"),
            _on_array(np.argmin),
        ),
        (
            "the order of the results",
            N_("it is returned in which order the results stand, and not the results"),
            _on_array(lambda x: np.argsort(-x, kind="stable")),
        ),
        (
            "the order of the results",
            N_("it is returned in which order the results stand, and not the results"),
            _on_array(lambda x: np.argsort(x, kind="stable")),
        ),
        ("whether, not how much", N_("it is returned whether there is something, not how much"),
         _on_array(lambda x: x > 0)),
        ("sorted, without repetitions", N_("each result stands only once, and they were sorted"),
         _on_array(_without_repetitions)),
        ("only the first of each", N_("of each result only the first entry is returned"),
         lambda _, v: [entry[:1] for entry in v]),
        ("only the last of each", N_("of each result only the last entry is returned"),
         lambda _, v: [entry[-1:] for entry in v]),
        ("shares of the whole", N_("the results were divided by their sum"), _on_array(_shares)),
        ("shares of the whole, in percent", N_("the results were divided by their sum, in percent"),
         _on_array(lambda x: 100 * _shares(x))),
        ("divided by the number", N_("the results were divided by their number"),
         _on_array(lambda x: x / len(x))),
        ("inverse", N_("the inverse matrix is returned"), _on_array(_inverse)),
        ("the sum", N_("the results were added up"), _on_array(np.sum)),
        ("the mean", N_("the mean of the results is returned"), _on_array(np.mean)),
        ("counts for entries", N_("it is returned how many there are, and not which"), _counts),
        ("empty ones left out", N_("those without any entry were left out"), _without_empty),
        ("a row of ones and zeros for an index", N_("a row of ones and zeros stands for an index"),
         _one_hot),
    ):  # fmt: skip
        yield told(name, sentence), change
    for relation in RELATIONS:
        yield relation.diagnosis, _deep(relation.change)
    for digits in (1, 2, 3, 4):
        words = n_(
            "the results were rounded to {digits} decimal; round only what you print",
            "the results were rounded to {digits} decimals; round only what you print",
            digits,
        ).format(digits=digits)
        rounded = Diagnosis(f"rounded to {digits} decimals", looks_as_if(words))
        yield rounded, _deep(_rounded_to(digits))
    for place, word in enumerate(PLACES[:2]):
        words = N_("the {nth} quantity is in degrees, and its rows and columns with it")
        yield (
            told(f"matrix in degrees ({word})", words, nth=_(word)),
            _on_array(_matrix_in_degrees(place)),
        )
        for quarter in (1, -1):
            words = N_("an angle is a quarter turn off (in the {nth} result)")
            yield (
                told(f"a quarter turn off ({word} result)", words, nth=_(word)),
                _at(place, _on_array(_turned_by(quarter * np.pi / 2))),
            )
    for place in range(max((len(cases[i]["args"]) for i in asked), default=0)):
        words = N_("the entries themselves are returned, not where they stand")
        yield told("entries for indices", words), _entries(place, None)
        yield told("entries for indices", words), _entries(place, -1)
    yield (
        told("a sum for a mean", N_("a sum stands for a mean: divide by the number")),
        lambda case, value: _on_array(lambda x: x * _size(case))(case, value),
    )
    yield (
        told("a mean for a sum", N_("a mean stands for a sum: do not divide by the number")),
        lambda case, value: _on_array(lambda x: x / _size(case))(case, value),
    )
    yield (
        told("N - 1 for N", N_("it was divided by N - 1 and not by N")),
        lambda case, value: _on_array(lambda x: x * _size(case) / (_size(case) - 1))(case, value),
    )
    for place, word in enumerate(PLACES):
        for relation in RELATIONS:
            yield (
                told(
                    f"{relation.name} ({word} result)",
                    N_("{words} (in the {nth} result)"),
                    words=_(relation.words),
                    nth=_(word),
                ),
                _at(place, _on_array(relation.change)),
            )
        for digits in (1, 2, 3):
            yield (
                told(
                    f"rounded to {digits} decimals ({word} result)",
                    N_("the {nth} result was rounded; round only what you print"),
                    nth=_(word),
                ),
                _at(place, _on_array(_rounded_to(digits))),
            )
        yield (
            told(
                f"from the other axis ({word} result)",
                N_("an angle is measured from the other axis (in the {nth} result)"),
                nth=_(word),
            ),
            _at(place, _on_array(lambda x: np.pi / 2 - x)),
        )
        yield (
            told(
                f"mask for indices ({word} result)",
                N_("the {nth} result is a mask, not indices"),
                nth=_(word),
            ),
            _at(place, _mask),
        )
        yield (
            told(
                f"points for indices ({word} result)",
                N_("the {nth} result holds the entries themselves, not their indices"),
                nth=_(word),
            ),
            _at(place, lambda case, value: case["args"][0][np.asarray(value, dtype=int)]),
        )
    yield told("mask for indices", N_("the result is a mask, not indices")), _mask
    for small in (np.uint8, np.int8, np.uint16, np.int16, np.int32):
        words = N_("numbers grew too large for their integer type and wrapped around")
        yield told(f"overflow of {small.__name__}", words), _deep(_wrapped(small))


def _argument(place: int) -> Change:
    return lambda case, _: case["args"][place]


def _on_array(change: Callable[[Value], Value]) -> Change:
    def changed(_: Values, value: Value) -> Value:
        array = np.asarray(value)
        if array.dtype.kind not in "iufb":
            raise _NotForThis
        found = change(array.astype(float) if array.dtype.kind == "b" else array)
        return found if isinstance(value, np.ndarray) else np.asarray(found).tolist()

    return changed


def _at(place: int, change: Change) -> Change:
    """A change of one of several results."""

    def changed(case: Values, value: Value) -> Value:
        if not (isinstance(value, list) and place < len(value) <= len(PLACES)):
            raise _NotForThis
        return [*value[:place], change(case, value[place]), *value[place + 1 :]]

    return changed


def _exchanged(_: Values, value: Value) -> Value:
    if not (isinstance(value, list) and len(value) == 2):
        raise _NotForThis
    return value[::-1]


def _deep(change: Callable[[Value], Value]) -> Change:
    """A change of every number in a value, lists of unequal lengths included."""
    whole = _on_array(change)

    def changed(case: Values, value: Value) -> Value:
        if isinstance(value, list) and any(isinstance(entry, list) for entry in value):
            return [changed(case, entry) if entry != [] else [] for entry in value]
        return whole(case, value)

    return changed


def _entries(place: int, level: int | None) -> Change:
    """The entries of an argument, or of one array in it, at the right indices."""

    def changed(case: Values, value: Value) -> Value:
        argument = case["args"][place]
        rows = np.asarray(argument if level is None else argument[level])
        indices = np.asarray(value)
        if indices.dtype.kind not in "iu":
            raise _NotForThis
        return rows[indices]

    return changed


def _one_more_entry(value: Value) -> Value:
    return np.append(value, 0)


def _sorted_down(value: Value) -> Value:
    return np.sort(value, axis=0)[::-1]


def _turned(value: Value) -> Value:
    if value.ndim != 2:
        raise _NotForThis
    return value[::-1, ::-1]


def _diagonal(value: Value) -> Value:
    if value.ndim != 2:
        raise _NotForThis
    return np.diag(value)


def _only_diagonal(value: Value) -> Value:
    return np.diag(_diagonal(value))


def _without_repetitions(value: Value) -> Value:
    if value.ndim != 1:
        raise _NotForThis
    return np.unique(value)


def _shares(value: Value) -> Value:
    whole = value.sum()
    return value / (whole if whole else 1)


def _inverse(value: Value) -> Value:
    if value.ndim != 2 or len(value) < 2:
        raise _NotForThis
    return np.linalg.inv(value)


def _rounded_to(digits: int) -> Callable[[Value], Value]:
    return lambda value: np.round(value, digits)


def _wrapped(small: type[np.integer[Any]]) -> Callable[[Value], Value]:
    """Whole numbers as an integer type leaves them."""

    def changed(value: Value) -> Value:
        if np.any(value != np.round(value)) or not np.isfinite(value).all():
            raise _NotForThis
        return np.asarray(value).astype(np.int64).astype(small)

    return changed


def _matrix_in_degrees(place: int) -> Callable[[Value], Value]:
    def changed(value: Value) -> Value:
        if value.ndim != 2 or value.shape[0] != value.shape[1] or place >= len(value) > 1:
            raise _NotForThis
        scale = np.ones(len(value))
        scale[place] = 180 / np.pi
        return value * np.outer(scale, scale)

    return changed


def _turned_by(angle: float) -> Callable[[Value], Value]:
    """An angle turned by another one, in (-pi, pi]."""
    return lambda value: np.pi - (np.pi - value - angle) % (2 * np.pi)


def _counts(_: Values, value: Value) -> Value:
    return [len(entry) for entry in value]


def _without_empty(_: Values, value: Value) -> Value:
    return [entry for entry in value if len(entry)]


def _one_hot(case: Values, value: Value) -> Value:
    indices = np.asarray(value)
    if indices.dtype.kind not in "iu" or indices.ndim != 1 or len(case["args"]) < 2:
        raise _NotForThis
    return indices[:, None] == np.arange(len(case["args"][1]))


def _transposed(value: Value) -> Value:
    if value.ndim != 2:
        raise _NotForThis
    return value.T


def _first(_: Values, value: Value) -> Value:
    return value[0]


def _mask(case: Values, value: Value) -> Value:
    mask = np.zeros(_size(case), dtype=bool)
    mask[np.asarray(value, dtype=int)] = True
    return mask


def _size(case: Values) -> int:
    return len(case["args"][0])
