"""A name for a wrong expression that no mistake of the key has, by its values."""

from __future__ import annotations

import time

import numpy as np
from numpy.typing import NDArray

from autograder.errors import CourseError
from autograder.kinds.expression.answer import ExpressionAnswer
from autograder.kinds.expression.marking import Points, same_values
from autograder.kinds.expression.question import Expression
from autograder.kinds.formula import evaluate_formula
from autograder.marking.diagnosis.relations import RELATIONS, Diagnosis
from autograder.marking.mutants.formula_edits import edited_formulas

MOST_SECONDS = 0.1  # of a processor, for one response

_WORDS = {
    "sign turned": "the sign of one term is turned round",
    "sign left out": "a minus sign was lost",
    "term left out": "a term is missing",
    "factor left out": "a factor is missing",
    "power left out": "a power is missing",
    "another function": "a function stands in the place of its relative, such as sine for cosine",
    "arguments exchanged": "two arguments have changed places",
    "function left out": "a function was left out",
    "constant one more": "a constant is off by one",
    "constant one less": "a constant is off by one",
}


def diagnose_expression(
    question: Expression, answer: ExpressionAnswer, points: Points, values: NDArray[np.complex128]
) -> Diagnosis | None:
    """The simplest relation to a right formula, or the mutant of it, with these values."""
    end = time.process_time() + MOST_SECONDS
    count = len(next(iter(points.values())))
    right = [entry for entry in answer.alternatives if not entry.is_mistake]
    for entry in right:
        period = float(evaluate_formula(entry.modulo, {})) if entry.modulo else None
        expected = np.broadcast_to(evaluate_formula(entry.expression, points), (count,))
        for relation in RELATIONS:
            with np.errstate(all="ignore"):
                changed = relation.change(np.asarray(expected, dtype=float))
            if same_values(changed, values, period) and not same_values(
                expected, changed.astype(complex), period
            ):
                return Diagnosis(relation.name, relation.sentence)
        with np.errstate(all="ignore"):
            ratios = values[np.abs(expected) > 1e-6] / expected[np.abs(expected) > 1e-6]
        if period is None and _is_constant(ratios, count // 2):
            return Diagnosis(
                "a constant factor",
                "It looks as if only a constant factor is wrong: the form is right.",
            )
        symbols = list(question.symbols)
        for mutant, text in edited_formulas(entry.expression, symbols):
            if time.process_time() > end:
                return None
            try:
                changed = np.broadcast_to(evaluate_formula(text, points), (count,))
            except CourseError:
                continue
            if same_values(changed, values, period):
                words = _WORDS.get(mutant.operator, f"{mutant.operator} somewhere in it")
                return Diagnosis(mutant.operator, f"It looks as if {words}.")
    return None


def _is_constant(ratios: NDArray[np.complex128], fewest: int) -> bool:
    if len(ratios) <= fewest or not np.all(np.isfinite(ratios)) or abs(ratios[0]) < 1e-6:
        return False
    if abs(ratios[0] - 1) < 1e-2:  # no factor that somebody meant
        return False
    return bool(np.max(np.abs(ratios - ratios[0])) <= 1e-7 * abs(ratios[0]))
