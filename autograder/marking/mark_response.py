"""One door to the five kinds: what came back from the student's process becomes a mark."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, TypeGuard

from autograder.course import answers as a
from autograder.course import questions as q
from autograder.kinds.expression.marking import mark_expression
from autograder.kinds.function.marking import mark_function
from autograder.kinds.number.marking import mark_number
from autograder.kinds.order.marking import mark_order
from autograder.kinds.true_false.marking import mark_true_false
from autograder.marking.mark import Mark, not_attempted
from autograder.marking.probe import Probe
from autograder.sandbox.inside.evaluate import REASONS


def mark_response(
    question: q.Question, answer: a.Answer, probe: Probe, response: Any, understood: str = ""
) -> Mark:
    """Mark one response.

    For true/false and order questions ``response`` is the list the student gave (None if there is
    none). For the others it is what `autograder.sandbox.inside.evaluate.evaluate` returned for
    the probe, and ``understood`` what the response looked like before any probe was sent.
    Nothing in it is trusted.
    """
    if isinstance(question, q.TrueFalse) and isinstance(answer, a.TrueFalseAnswer):
        if response is None:
            return not_attempted(question)
        return mark_true_false(question, answer, response)
    if isinstance(question, q.Order) and isinstance(answer, a.OrderAnswer):
        if response is None:
            return not_attempted(question)
        return mark_order(question, answer, response)
    response = response if isinstance(response, dict) else {}
    mark = _mark_evaluated(question, answer, probe, response, understood)
    return mark if mark.understood else replace(mark, understood=understood)


def _mark_evaluated(
    question: q.Question,
    answer: a.Answer,
    probe: Probe,
    response: dict[str, Any],
    understood: str,
) -> Mark:
    state, reason = _text(response.get("state")), _text(response.get("reason"))
    if state == "not attempted":
        return not_attempted(question)
    if state == "unusable" and reason == "missing":
        return not_attempted(question, f"Nothing called {question.name} was found.")
    if state == "raised":
        feedback = f"Evaluating {question.name} raised an exception."
        return Mark(question.id, "error", 0.0, question.points, feedback)
    if state == "given":
        if isinstance(question, q.Number) and isinstance(answer, a.NumberAnswer):
            value = response.get("value")
            if _is_finite_number(value):
                return mark_number(question, answer, value, understood)
        if isinstance(question, q.Expression) and isinstance(answer, a.ExpressionAnswer):
            return mark_expression(question, answer, probe.points, response.get("values"))
        if (
            isinstance(question, q.Function)
            and isinstance(answer, a.FunctionAnswer)
            and probe.expected is not None
        ):
            return mark_function(question, answer, probe.expected, response.get("outcomes"))
    said = REASONS.get(reason, "it could not be read")
    if reason == "symbol unknown" and isinstance(question, q.Expression):
        said += " (declared are " + ", ".join(name for name, _ in question.symbols) + ")"
    return Mark(
        question.id,
        "wrong",
        0.0,
        question.points,
        f"{question.name} cannot be marked: {said}.",
        alternative="not usable",
    )


def _text(value: Any) -> str:
    return value if isinstance(value, str) else ""


def _is_finite_number(value: Any) -> TypeGuard[int | float]:
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    try:
        return math.isfinite(value)
    except OverflowError:  # an integer of 400 digits
        return False
