"""A name for a wrong number that no mistake of the key has."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from decimal import Decimal
from functools import lru_cache

import numpy as np

from autograder.diagnosis.relations import RELATIONS, Diagnosis, another_answer, looks_as_if
from autograder.kinds.number.answer import NumberAnswer
from autograder.kinds.number.question import Number
from autograder.kinds.number.variations import variations
from autograder.language import N_, _, chosen
from autograder.questions.drawn import NOTHING_AROUND, Around

_ENOUGH = 1e-4  # of the size of a number: closer than chance brings one to another
_FEW = 2e-3  # a value of so few digits is near many things, and only the plainest are tried
_TELLING = 10  # a smaller whole number comes out of too many formulas
_PLAINEST = ("sign turned", "in percent", "complement", "twice", "half")
_OF_PAIRS = ("sign turned", "in percent", "complement", "twice", "half", "squared", "its root")


def diagnose_number(
    question: Number, answer: NumberAnswer, value: float, around: Around = NOTHING_AROUND
) -> Diagnosis | None:
    """The simplest way from what is right to a value, if one fits the digits that were given."""
    right = [entry.value for entry in answer.alternatives if not entry.is_mistake]
    coarse = not question.integer and _half_a_digit(value) > _FEW * abs(value)
    for diagnosis, wrong in _simple(question, right):
        exactly = math.isclose(value, wrong, rel_tol=1e-9)
        if coarse and diagnosis.name not in _PLAINEST and not exactly:
            continue
        if _is_near(question, wrong, value) and not _is_right(question, right, wrong):
            return diagnosis
    for wrong, words in _roundings(question, right):
        if math.isclose(value, wrong, rel_tol=1e-12) and not _is_right(question, right, wrong):
            return Diagnosis("rounded too coarsely", looks_as_if(_(words)))
    for other, key in around.neighbors:
        for entry in key.alternatives:
            theirs = getattr(entry, "value", None)
            if entry.is_mistake or theirs is None or _is_right(question, right, theirs):
                continue
            if _is_near(question, theirs, value):
                return Diagnosis(
                    "another question's answer",
                    another_answer(other.id, other.title),
                )
    found: dict[str, Diagnosis] = {}
    known = _known_variations(answer.code, tuple(around.numbers.items()), chosen())
    for name, words, wrong in known:
        exactly = math.isclose(value, wrong, rel_tol=1e-9)
        near = _is_near(question, wrong, value) and not coarse
        if (exactly or near) and not _is_right(question, right, wrong):
            found.setdefault(name, Diagnosis(name, looks_as_if(words)))
    if len(found) > 1 and question.integer and abs(value) < _TELLING:
        return None
    if found:
        return next(iter(found.values()))
    if question.integer:
        return None
    relations = [r for r in RELATIONS if r.name in (_PLAINEST if coarse else _OF_PAIRS)]
    for first, second in itertools.permutations(relations, 2):
        for expected in right:
            with np.errstate(all="ignore"):
                wrong = float(second.change(first.change(np.asarray(expected, dtype=float))))
            if _is_near(question, wrong, value) and not _is_right(question, right, wrong):
                return first.and_then(second)
    return None


@lru_cache(maxsize=256)  # a class with numbers of their own has many
def _known_variations(
    code: str, numbers: tuple[tuple[str, float], ...], language: str
) -> tuple[tuple[str, str, float], ...]:
    """The variations with their words in the language that is spoken."""
    return tuple(variations(code, dict(numbers)))


def _simple(question: Number, right: list[float]) -> Iterator[tuple[Diagnosis, float]]:
    for relation in RELATIONS:
        if question.integer and relation.name.startswith("rounded"):
            continue
        for expected in right:
            with np.errstate(all="ignore"):
                changed = float(relation.change(np.asarray(expected, dtype=float)))
            if np.isfinite(changed):
                yield relation.diagnosis, changed


def _roundings(question: Number, right: list[float]) -> Iterator[tuple[float, str]]:
    """What is right with fewer decimals than are asked for, or cut off, or rounded up."""
    for expected in right:
        for decimals in range(1, question.decimals or 0):
            yield (
                round(expected, decimals),
                N_("it was rounded to fewer decimals than are asked for"),
            )
        if question.decimals:
            size = 10.0**question.decimals
            up, down = math.ceil(expected * size), math.floor(expected * size)
            yield up / size, N_("it was rounded up, and not to the nearest")
            yield down / size, N_("it was cut off, and not rounded to the nearest")


def _is_near(question: Number, wrong: float, value: float) -> bool:
    """Whether a value is a wrong one, as far as its digits go."""
    if question.integer and (value == round(value) or wrong == round(wrong)):
        return abs(wrong - value) <= question.tolerance
    near = _ENOUGH * abs(wrong)
    if _half_a_digit(value) <= 0.05 * abs(value):
        near = max(near, _half_a_digit(value) * (1 + 1e-9))
    return abs(wrong - value) <= near


def _is_right(question: Number, right: list[float], wrong: float) -> bool:
    """Whether a wrong way leads so close to what is right that it cannot be told from it."""
    return any(
        abs(wrong - expected) <= max(4 * _ENOUGH * abs(wrong), question.tolerance)
        if not question.integer
        else abs(wrong - expected) <= question.tolerance
        for expected in right
    )


def _half_a_digit(value: float) -> float:
    """Half of the last decimal that a number is written with; nothing for a whole number."""
    exponent = Decimal(repr(float(value))).normalize().as_tuple().exponent
    return 0.5 * 10.0**exponent if isinstance(exponent, int) and exponent < 0 else 0.0
