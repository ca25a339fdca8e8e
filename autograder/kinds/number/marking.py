"""A value, compared with the known values of the answer."""

from __future__ import annotations

from typing import Any

from autograder.kinds.mark import Mark, status_for
from autograder.kinds.number.answer import NumberAnswer
from autograder.kinds.number.question import Number


def mark_number(
    question: Number, answer: NumberAnswer, value: int | float, understood: str = ""
) -> Mark:
    """The first alternative within its tolerance decides.

    ``understood`` is how the response looked before anything hidden was sent to its process, and
    that is what the student is shown: the value itself may by now be a hidden input, kept by one
    function and given back by another object, unless it is a value that the key knows.
    """
    known: dict[str, Any] = {
        "explanation": answer.explanation,
        "understood": _as_number(understood, question),
    }
    for alternative in answer.alternatives:
        tolerance = alternative.tolerance
        if abs(value - alternative.value) <= (
            question.tolerance if tolerance is None else tolerance
        ):
            known["understood"] = known["understood"] or _with_unit(value, question)
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
    known["understood"] = known["understood"] or understood
    return Mark(question.id, "wrong", 0.0, question.points, feedback, **known)


def _as_number(understood: str, question: Number) -> str:
    """The text as a number with its unit; nothing if it is none, such as sympy's ``log(3)``."""
    try:
        return _with_unit(float(understood), question)
    except ValueError:
        return ""


def _with_unit(value: int | float, question: Number) -> str:
    return f"{value:.10g}" + (f" {question.unit}" if question.unit else "")
