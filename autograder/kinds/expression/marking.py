"""An expression, compared by its values at hidden points. No text of a student is parsed here."""

from __future__ import annotations

import zlib
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from autograder.exchange.messages import Message
from autograder.kinds.expression.answer import ExpressionAlternative, ExpressionAnswer
from autograder.kinds.expression.diagnosis import diagnose_expression
from autograder.kinds.expression.equal_values import Points, nearly_equal, same_values
from autograder.kinds.expression.question import MOST_ROOTS, Expression
from autograder.language import _, n_
from autograder.questions.drawn import NOTHING_AROUND, Around
from autograder.questions.key_formulas import evaluate_formula
from autograder.questions.mark import Mark, status_for

POINT_COUNT = 24


def hidden_points(answer: ExpressionAnswer, rng: np.random.Generator) -> Points:
    """Values for every symbol, each an array of shape (2 * POINT_COUNT,).

    In the second half only the symbols in ``free_of``, and what is derived from them, differ from
    the first half: an expression that is free of them has the same values twice.
    """
    points: Points = {}
    for name, (low, high) in answer.sample.items():
        first = rng.uniform(low, high, POINT_COUNT)
        second = rng.uniform(low, high, POINT_COUNT) if name in answer.free_of else first
        points[name] = np.concatenate([first, second])
    for name, formula in answer.derived.items():
        points[name] = evaluate_formula(formula, points)
    return points


def mark_expression(
    question: Expression,
    answer: ExpressionAnswer,
    points: Points,
    values: object,
    around: Around = NOTHING_AROUND,
) -> Mark:
    """The first alternative with the same values decides.

    Of several roots, each of which has a row of values, the one that earns least decides: a list of
    them is right only where each is.

    ``values`` are the response's values at ``points``, of any type: they come from the student's
    process and are not trusted.
    """
    if isinstance(values, np.ndarray) and values.ndim == 2 and 0 < len(values) <= MOST_ROOTS:
        marks = [mark_expression(question, answer, points, row, around) for row in values]
        worst = min(marks, key=lambda mark: mark.credit)
        right = sum(mark.credit == 1 for mark in marks)
        if right == len(marks) or right == 0:
            return worst
        said = n_(
            "{right} of your {count} results is right. About another one:",
            "{right} of your {count} results are right. About another one:",
            right,
        ).format(right=right, count=len(marks))
        return replace(worst, feedback=f"{said} {worst.feedback}")
    count = len(next(iter(points.values())))
    known: Message = {"explanation": answer.explanation}
    if not (
        isinstance(values, np.ndarray) and values.shape == (count,) and values.dtype.kind in "fc"
    ):
        return Mark(
            question.id, "wrong", 0.0, question.points, _("It has no numeric values."), **known
        )
    if answer.free_of and not nearly_equal(values[: count // 2], values[count // 2 :]):
        return Mark(
            question.id,
            "wrong",
            0.0,
            question.points,
            answer.free_of_feedback
            or _("It still depends on {symbols}.").format(symbols=", ".join(answer.free_of)),
            alternative=f"depends on {', '.join(answer.free_of)}",
            **known,
        )
    for alternative in answer.alternatives:
        if matches(alternative, points, values):
            return Mark(
                question.id,
                status_for(alternative.credit),
                alternative.credit,
                question.points,
                alternative.feedback or _("Right."),
                alternative=alternative.name,
                **known,
            )
    found = diagnose_expression(question, answer, points, values.astype(complex), around)
    if found is not None:
        return Mark(
            question.id,
            "wrong",
            0.0,
            question.points,
            found.sentence,
            found.name,
            evidence=found.evidence,
            **known,
        )
    return Mark(
        question.id,
        "wrong",
        0.0,
        question.points,
        _(
            "It differs from the right expression, and from the mistakes known here. Put a simple "
            "data set into both sides and see where they part."
        ),
        evidence=f"values {zlib.crc32(','.join(f'{v:.6g}' for v in values).encode()):08x}",
        **known,
    )


def matches(
    alternative: ExpressionAlternative, points: Points, values: NDArray[np.complex128]
) -> bool:
    """Whether the values are those of the alternative at the points where that is defined."""
    count = len(next(iter(points.values())))
    expected = np.broadcast_to(evaluate_formula(alternative.expression, points), (count,))
    period = None
    if alternative.modulo is not None:
        period = float(evaluate_formula(alternative.modulo, {}))
    return same_values(expected, values, period)
