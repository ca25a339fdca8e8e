"""A name for a wrong expression that no mistake of the key has, by its values."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from autograder.diagnosis.relations import (
    RELATIONS,
    Diagnosis,
    another_answer,
    looks_as_if,
)
from autograder.errors import CourseError
from autograder.kinds.expression.answer import ExpressionAlternative, ExpressionAnswer
from autograder.kinds.expression.equal_values import Points, almost_same_values, same_values
from autograder.kinds.expression.question import Expression
from autograder.kinds.expression.slopes import slopes
from autograder.kinds.expression.wrong_throughout import terms, wholes
from autograder.language import N_, _, chosen
from autograder.mutants.formula_edits import edited_formulas
from autograder.mutants.mutant import Mutant
from autograder.questions.drawn import NOTHING_AROUND, Around
from autograder.questions.key_formulas import evaluate_formula

_MOST_TERMS = 8  # that a fit may have, of 24 points
_FACTORS = {2.0: "doubled", 0.5: "halved", -1.0: "turned", 0.0: "missing", -2.0: "turned"}

Values = NDArray[np.complex128]

_WORDS = {
    "sign turned": N_("the sign of one term is turned round"),
    "sign left out": N_("a minus sign was lost"),
    "term left out": N_("a term is missing"),
    "factor left out": N_("a factor is missing"),
    "power left out": N_("a power is missing"),
    "another function": N_(
        "a function stands in the place of its relative, such as sine for cosine"
    ),
    "arguments exchanged": N_("two arguments have changed places"),
    "function left out": N_("a function was left out"),
    "constant one more": N_("a constant is off by one"),
    "constant one less": N_("a constant is off by one"),
}
# What a symbol may have become in one place, by the end of the mutant's operator.
_OF_A_SYMBOL = {
    "doubled": N_("{symbol} is doubled somewhere in it"),
    "halved": N_("{symbol} is halved somewhere in it"),
    "squared": N_("{symbol} is squared somewhere in it"),
    "its root": N_("the root of {symbol} stands somewhere in it for {symbol}"),
    "sign turned": N_("the sign of {symbol} is turned round somewhere in it"),
    "left out": N_("{symbol} is left out somewhere in it"),
}

_ONCE_MORE = {
    "multiplied": N_("it was multiplied by {symbol} once more than asked for"),
    "divided": N_("it was divided by {symbol} once more than asked for"),
}


def diagnose_expression(
    question: Expression,
    answer: ExpressionAnswer,
    points: Points,
    values: Values,
    around: Around = NOTHING_AROUND,
) -> Diagnosis | None:
    """The simplest way from a right formula to one with these values."""
    right = (entry for entry in answer.alternatives if not entry.is_mistake)
    tried = (
        diagnosis
        for entry in right
        for diagnosis in _diagnoses(question, entry, points, values, around)
    )
    return next((diagnosis for diagnosis in tried if diagnosis is not None), None)


def _diagnoses(
    question: Expression,
    entry: ExpressionAlternative,
    points: Points,
    values: Values,
    around: Around,
) -> Iterator[Diagnosis | None]:
    """One after the other of what may have gone wrong, None where it does not fit."""
    count = len(next(iter(points.values())))
    period = float(evaluate_formula(entry.modulo, {})) if entry.modulo else None
    expected = np.broadcast_to(evaluate_formula(entry.expression, points), (count,)).astype(float)

    def fits(wrong: np.ndarray | None) -> bool:
        if wrong is None or same_values(expected, wrong.astype(complex), period):
            return False
        return same_values(wrong, values, period)

    def of(text: str, at: Mapping[str, NDArray[np.float64]] = points) -> np.ndarray | None:
        try:
            return np.broadcast_to(evaluate_formula(text, at), next(iter(at.values())).shape)
        except CourseError:  # it has a symbol that is not drawn here
            return None

    def told(found: bool, name: str, words: str, evidence: str = "") -> Diagnosis | None:
        return Diagnosis(name, looks_as_if(words), evidence) if found else None

    for relation in RELATIONS:
        with np.errstate(all="ignore"):
            found = fits(relation.change(expected))
        yield relation.diagnosis if found else None
    for symbol in question.symbols:
        with np.errstate(all="ignore"):
            changed = {
                "multiplied": expected * points[symbol],
                "divided": expected / points[symbol],
            }
            for how, wrong in changed.items():
                words = _(_ONCE_MORE[how]).format(symbol=symbol)
                yield told(period is None and fits(wrong), f"{how} by {symbol}", words)
    for other, key in around.neighbors:
        for theirs in key.alternatives:
            text = getattr(theirs, "expression", None)
            if text is not None and not theirs.is_mistake and fits(of(text)):
                said = another_answer(other.id, other.title)
                yield Diagnosis("another question's answer", said)
    if period is None and (factor := _constant(values, expected)) is not None:
        words = _("only a constant factor is wrong: the form is right")
        yield told(True, "a constant factor", words, f"factor {factor:.6g}")
    elif period is not None:
        for factor in (3.0, 4.0, 0.25):
            words = _("a constant factor is wrong: look at where you double or halve")
            yield told(fits(expected * factor), "a constant factor", words, f"factor {factor:g}")
    whole, edited = _changed(entry.expression, tuple(question.symbols), chosen())
    for name, words, text in whole:
        yield told(fits(of(text)), name, words, text)
    if period is None:
        yield _by_terms(question, terms(entry.expression), of, values)
        for name, words, wrong in slopes(of, entry.expression, list(question.symbols), points):
            yield told(fits(wrong) or _nearly(wrong, values), name, words)
    for mutant, text in edited:
        words = _of_one_place(mutant.operator)
        yield told(fits(of(text)), mutant.operator, words, mutant.name)
    for name, words, text in whole:
        off = of(text)
        if off is None or period is not None:
            continue
        if _constant(values, off) is not None:
            said = _(
                "It looks as if there are two things: {first}; and a constant factor or the sign "
                "is wrong."
            ).format(first=words)
            yield Diagnosis(f"{name}, and a constant factor", said, text)
    words = _(
        "a number in it was rounded, such as 3.14 for pi: the values come close to the right ones"
    )
    yield told(almost_same_values(expected, values, period), "a rounded number", words)


@lru_cache(maxsize=256)  # a class with numbers of their own has many
def _changed(
    formula: str, symbols: tuple[str, ...], language: str
) -> tuple[tuple[tuple[str, str, str], ...], tuple[tuple[Mutant, str], ...]]:
    """The right formula with one thing wrong throughout, and in one place.

    The words are in the language that is spoken.
    """
    return tuple(wholes(formula, symbols)), tuple(edited_formulas(formula, symbols))


def _of_one_place(operator: str) -> str:
    """A change in one place of the formula, in words."""
    if operator in _WORDS:
        return _(_WORDS[operator])
    other, stands, name = operator.partition(" for ")
    if stands:
        sentence = _("{other} stands somewhere in it for {symbol}")
        return sentence.format(other=other, symbol=name)
    name, _blank, what = operator.partition(" ")
    return _(_OF_A_SYMBOL[what]).format(symbol=name)


def _by_terms(
    question: Expression,
    parts: Sequence[str],
    of: Callable[[str], np.ndarray | None],
    values: Values,
) -> Diagnosis | None:
    """Which of the right formula's terms have another factor, by a linear fit."""
    columns = [column for part in parts if (column := of(part)) is not None]
    if not 2 <= len(parts) <= _MOST_TERMS or len(columns) < len(parts):
        return None
    matrix = np.column_stack(columns)
    half = len(values) // 2
    if not (np.isfinite(matrix).all() and np.isfinite(values).all()):
        return None
    if np.abs(values.imag).max() > 1e-9 or np.linalg.matrix_rank(matrix[:half]) < len(parts):
        return None
    factors: NDArray[np.float64] = np.linalg.lstsq(matrix, values.real, rcond=None)[0]
    size = np.maximum(np.abs(values.real), 1e-3)
    with np.errstate(all="ignore"):
        if not np.all(np.abs(matrix @ factors - values.real) <= 1e-7 * size):
            return None
    factors = np.round(factors, 6)
    wrong = [i for i, factor in enumerate(factors) if factor != 1]
    evidence = "; ".join(f"{factors[i]:g} times the term {parts[i]}" for i in wrong)
    if not wrong or len(wrong) == len(parts):
        return None
    if len(wrong) > 1:
        return Diagnosis(
            "several terms",
            _(
                "It looks as if {wrong} of the {count} terms have a wrong factor or sign, and the "
                "others are right."
            ).format(wrong=len(wrong), count=len(parts)),
            evidence,
        )
    (place,) = wrong
    how = _FACTORS.get(float(factors[place]), "")
    which = _which(question, parts, place)
    name, words = {
        "missing": ("a term missing", _("{term} is missing; the others are right")),
        "doubled": ("a term doubled", _("{term} is counted twice; the others are right")),
        "halved": (
            "a term halved",
            _("{term} is there with half its factor only; the others are right"),
        ),
        "turned": ("the sign of a term", _("{term} has the wrong sign; the others are right")),
    }.get(how, ("the factor of a term", _("{term} has a wrong factor; the others are right")))
    return Diagnosis(name, looks_as_if(words.format(term=which)), evidence)


def _which(question: Expression, parts: Sequence[str], place: int) -> str:
    """A term by the symbols that only it has, without what else it is made of."""
    own = [s for s in question.symbols if s in _names(parts[place])]
    others = [_names(part) for i, part in enumerate(parts) if i != place]
    telling = [s for s in own if not any(s in names for names in others)]
    if not telling:
        return _("one term")
    return _("the term with {symbols}").format(symbols=f" {_('and')} ".join(telling))


def _names(text: str) -> set[str]:
    return {node.id for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Name)}


def _constant(values: Values, expected: np.ndarray) -> float | None:
    """The factor by which all values differ, if it is one that somebody meant."""
    telling = np.abs(expected) > 1e-6
    if telling.sum() <= len(expected) // 2:
        return None
    with np.errstate(all="ignore"):
        ratios = values[telling] / expected[telling]
        spread = np.max(np.abs(ratios - ratios[0]))
    if not np.all(np.isfinite(ratios)) or abs(ratios[0]) < 1e-6 or abs(ratios[0] - 1) < 1e-2:
        return None
    if spread > 1e-7 * abs(ratios[0]) or abs(ratios[0].imag) > 1e-9:
        return None
    return float(ratios[0].real)


def _nearly(wrong: np.ndarray, values: Values) -> bool:
    """Whether values are others that were found by small steps, and so are less exact."""
    if not np.isfinite(wrong).all() or np.ptp(wrong) < 1e-6:
        return False
    scale = np.maximum(np.abs(wrong), 1e-2 * np.abs(wrong).max())
    return bool(np.all(np.abs(values - wrong) <= 1e-5 * scale))
