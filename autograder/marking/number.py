"""A value, compared with the known values of the answer."""

from __future__ import annotations

from typing import Any

from autograder.answers import NumberAnswer
from autograder.marking.mark import Mark, status_for
from autograder.questions import Number


def mark_number(question: Number, answer: NumberAnswer, value: int | float) -> Mark:
    """The first alternative within its tolerance decides."""
    known: dict[str, Any] = {
        "explanation": answer.explanation,
        "understood": f"{value:.10g}" + (f" {question.unit}" if question.unit else ""),
    }
    for alternative in answer.alternatives:
        tolerance = alternative.tolerance
        if abs(value - alternative.value) <= (
            question.tolerance if tolerance is None else tolerance
        ):
            return Mark(
                question.id,
                status_for(alternative.credit),
                alternative.credit,
                question.points,
                alternative.feedback or "Right.",
                alternative=alternative.name,
                **known,
            )
    if question.integer and value != round(value):
        feedback = "A whole number is asked for. Decide whether to round up or down, and why."
    else:
        feedback = (
            "That is not the value asked for. A hint may help: look at what each symbol counts."
        )
    return Mark(question.id, "wrong", 0.0, question.points, feedback, **known)
