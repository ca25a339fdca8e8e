"""Values that are right but for their form: repaired, they are right by the question's own measure.

A relation makes of what is right what was given. Where the key forgives more than equal numbers
(indices in any order, a fit to six digits), only the other direction tells: what was given is
repaired, and must then count as right.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from autograder.exchange.messages import Value, Values
from autograder.language import N_, _

Case = Values
Repair = Callable[[Case, object, object], object]  # of a case, what is right, and what was given
PLACES = (N_("first"), N_("second"), N_("third"), N_("fourth"))
_MOST_NUMBERS = 20_000


class NotForThis(Exception):
    """A repair has no meaning for a value."""


def repairs() -> Iterator[tuple[str, str, Repair]]:
    """Every repair: the name of what is wrong, what it looks like, and how it is put right.

    What it looks like is said in the language that is spoken.
    """
    in_one, in_each = _("{words}, in the {nth} result"), _("{words}, in each of the results")
    in_part = _("{words}, in the {nth} part of each of the results")
    for name, words, repair in _OF_WHOLES:
        yield name, _(words), repair
    for name, words, repair in _OF_RESULTS:
        for place, nth in enumerate(PLACES):
            yield (
                f"{name} ({nth} result)",
                in_one.format(words=_(words), nth=_(nth)),
                _at(place, repair),
            )
    for name, words, repair in (*_OF_WHOLES[:2], *_OF_RESULTS):
        yield f"{name}, in each", in_each.format(words=_(words)), _in_each(repair)
        for place, nth in enumerate(PLACES[:2]):
            yield (
                f"{name} ({nth} of each)",
                in_part.format(words=_(words), nth=_(nth)),
                _in_each(_at(place, repair)),
            )
    for name, words, repair in _UNUSUAL:
        yield name, _(words), repair
    yield from _pairs()


def _pairs() -> Iterator[tuple[str, str, Repair]]:
    """Two of them together: a form that is wrong for the whole, and something in the results."""
    both, in_one = _("{one}, and {other}"), _("{words}, in the {nth} result")
    for outer, said, first in _OF_WHOLES[:4]:
        for inner, words, then in _OF_RESULTS:
            name = f"{outer}, and {inner}"
            together = both.format(one=_(said), other=_(words))
            yield name, together, _one_after_the_other(first, then)
            for place, nth in enumerate(PLACES[:2]):
                yield (
                    f"{name} ({nth} result)",
                    in_one.format(words=together, nth=_(nth)),
                    _one_after_the_other(first, _at(place, then)),
                )
    in_two = _("{one}, in the first result, and {other}, in the second")
    for one, said, first in _OF_RESULTS:
        for two, words, then in _OF_RESULTS:
            yield (
                f"{one} (first result), and {two} (second result)",
                in_two.format(one=_(said), other=_(words)),
                _one_after_the_other(_at(0, first), _at(1, then)),
            )


def _one_after_the_other(first: Repair, then: Repair) -> Repair:
    return lambda case, right, given: then(case, right, first(case, right, given))


def _other_order(_: Case, right: object, given: object) -> object:
    if not (isinstance(given, list) and len(given) == 2 and isinstance(right, list)):
        raise NotForThis
    return given[::-1]


def _only_the_first(_: Case, right: object, given: object) -> object:
    if not (isinstance(right, list) and len(right) in (2, 3, 4)):
        raise NotForThis
    return [given, *right[1:]]


def _without_more(_: Case, right: object, given: object) -> object:
    """One result or several, and beside them something else."""
    if isinstance(right, int | float) and isinstance(given, list) and 2 <= len(given) <= 4:
        return given[0]
    if not (isinstance(right, list) and isinstance(given, list) and 2 <= len(right) < len(given)):
        raise NotForThis
    if len(given) > len(PLACES):
        raise NotForThis  # a list of results, and not one of each
    return given[: len(right)]


def _reversed(_: Case, right: object, given: Value) -> object:
    return given[::-1]


def _in_shape(_: Case, right: object, given: object) -> object:
    array, wanted = np.asarray(given), np.asarray(right)
    if array.dtype.kind not in "iufb" or array.shape == wanted.shape or array.size != wanted.size:
        raise NotForThis
    if array.size < 2 and array.ndim == 0 == wanted.ndim:
        raise NotForThis
    shaped = array.reshape(wanted.shape)
    return shaped if isinstance(right, np.ndarray) else shaped.tolist()


def _list_of_dict(_: Case, right: object, given: object) -> object:
    if not isinstance(given, dict) or isinstance(right, dict):
        raise NotForThis
    return list(given.values())


def _of_text(_: Case, right: object, given: object) -> object:
    if isinstance(given, str) and isinstance(right, int | float):
        return float(given)
    raise NotForThis


def _numbers(given: object) -> np.ndarray:
    array = np.asarray(given)
    if array.dtype.kind not in "iuf" or array.size > _MOST_NUMBERS:
        raise NotForThis
    return array


def _like(given: object, made: np.ndarray) -> object:
    return made if isinstance(given, np.ndarray) else made.tolist()


def _less_one(_: Case, right: object, given: object) -> object:
    return _like(given, _numbers(given) - 1)


def _radians(_: Case, right: object, given: object) -> object:
    return _like(given, np.radians(_numbers(given)))


def _negative(_: Case, right: object, given: object) -> object:
    return _like(given, -_numbers(given))


def _sum_of_terms(_: Case, right: object, given: object) -> object:
    terms = _numbers(given)
    if not isinstance(right, int | float) or terms.ndim != 1:
        raise NotForThis
    return float(terms.sum())


def _whole(_: Case, right: object, given: object) -> object:
    array = np.asarray(given)
    if array.size == 0:
        return given
    if array.dtype.kind != "f" or not np.all(array == np.round(array)):
        raise NotForThis
    return _like(given, array.astype(int))


def _of_mask(_: Case, right: object, given: object) -> object:
    mask = np.asarray(given)
    if mask.dtype.kind != "b" or mask.ndim != 1:
        raise NotForThis
    return np.flatnonzero(mask)


def _of_others(case: Case, right: Value, given: object) -> Value:
    array = _numbers(given)
    count = len(case["args"][0])
    if array.dtype.kind not in "iu" or array.ndim != 1 or not np.all(array < count):
        raise NotForThis
    return np.setdiff1d(np.arange(count), array)


def _of_entries(case: Case, right: object, given: Value) -> Value:
    """The indices of entries of the first argument."""
    entries, rows = np.asarray(case["args"][0]), np.asarray(given)
    if entries.ndim < 1 or rows.ndim != entries.ndim or rows.shape[1:] != entries.shape[1:]:
        raise NotForThis
    if rows.size * len(entries) > 50 * _MOST_NUMBERS:
        raise NotForThis
    same = (rows[:, None] == entries[None]).reshape(len(rows), len(entries), -1).all(axis=2)
    if not same.any(axis=1).all():
        raise NotForThis
    return np.flatnonzero(same.any(axis=0))


def _of_count(_: Case, right: Value, given: object) -> object:
    if isinstance(given, bool | list | np.ndarray) or given != len(right):
        raise NotForThis
    return right


def _of_pairs(_: Case, right: Value, given: Value) -> Value:
    """The first of each entry, where something stands beside what is asked for."""
    rows = np.asarray(given)
    if rows.size == 0:
        return given
    if rows.ndim != 2 or rows.shape[1] < 2 or np.asarray(right).ndim != 1:
        raise NotForThis
    return _like(given, rows[:, 0])


def _at(place: int, repair: Repair) -> Repair:
    def repaired(case: Case, right: Value, given: object) -> object:
        if not (isinstance(given, list) and place < len(given) == len(right) <= len(PLACES)):
            raise NotForThis
        mended = repair(case, right[place], given[place])
        return [*given[:place], mended, *given[place + 1 :]]

    return repaired


def _in_each(repair: Repair) -> Repair:
    def repaired(case: Case, right: object, given: object) -> object:
        if not (isinstance(given, list) and isinstance(right, list) and len(given) == len(right)):
            raise NotForThis
        pairs = zip(right, given, strict=True)
        return [repair(case, wanted, entry) for wanted, entry in pairs]

    return repaired


_OF_WHOLES: tuple[tuple[str, str, Repair], ...] = (
    ("other order", N_("two results are returned in the other order"), _other_order),
    ("only the first", N_("only the first of the results is returned"), _only_the_first),
    ("reversed", N_("the results stand in reverse order"), _reversed),
    (
        "more results",
        N_("something is returned beside the results that are asked for"),
        _without_more,
    ),
    (
        "wrong shape",
        N_("the numbers are right and their shape is not the one asked for"),
        _in_shape,
    ),
    ("a dictionary for a list", N_("a dictionary is returned in place of a list"), _list_of_dict),
    ("a text for a number", N_("a text is returned in place of a number"), _of_text),
)
_OF_RESULTS: tuple[tuple[str, str, Repair], ...] = (
    ("mask for indices", N_("a mask is returned and not indices"), _of_mask),
    (
        "points for indices",
        N_("the entries themselves are returned, not their indices"),
        _of_entries,
    ),
    ("a count for indices", N_("it is returned how many there are, and not which"), _of_count),
    ("the others", N_("exactly those are returned that are not asked for"), _of_others),
    ("one more", N_("the count begins or ends one too late"), _less_one),
    (
        "floats for indices",
        N_("indices are floats and not whole numbers"),
        _whole,
    ),
    ("degrees", N_("an angle is in degrees; radians are asked for"), _radians),
    ("sign turned", N_("the sign is turned round"), _negative),
    (
        "more than asked for",
        N_("something stands beside each entry that is not asked for"),
        _of_pairs,
    ),
)
_UNUSUAL: tuple[tuple[str, str, Repair], ...] = (
    *_OF_RESULTS[:2],
    ("a count for indices", *_OF_RESULTS[2][1:]),
    ("the others", *_OF_RESULTS[3][1:]),
    _OF_RESULTS[-1],
    (
        "terms for a sum",
        N_("the single terms are returned and not their sum"),
        _sum_of_terms,
    ),
)
