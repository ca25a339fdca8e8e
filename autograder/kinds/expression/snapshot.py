"""How a student bundle checks an expression: its right values at a few points."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace

import numpy as np

from autograder.exchange.messages import Message
from autograder.kinds.expression.answer import ExpressionAnswer
from autograder.kinds.expression.equal_values import Points, same_values
from autograder.kinds.expression.marking import POINT_COUNT
from autograder.kinds.expression.question import Expression
from autograder.kinds.formula import evaluate_formula
from autograder.kinds.mark import Mark
from autograder.kinds.snapshot import LATER, wrong
from autograder.language import _
from autograder.marking.diagnosis.relations import RELATIONS, Diagnosis

_POINTS = 6
_TELLING = 4  # different values, for a relation to say anything


def take_snapshot(answer: ExpressionAnswer, points: Points) -> Message:
    """Some of the points, and the values of what is right there."""
    # Some of both halves, so that what must not depend on a symbol is seen to depend on it.
    chosen = [*range(_POINTS), *range(POINT_COUNT, POINT_COUNT + _POINTS)]
    points = {name: values[chosen] for name, values in points.items()}
    accepted = [
        {
            "values": np.broadcast_to(
                evaluate_formula(entry.expression, points), (len(chosen),)
            ).copy(),
            "modulo": float(evaluate_formula(entry.modulo, {})) if entry.modulo else None,
        }
        for entry in answer.alternatives
        if not entry.is_mistake
    ]
    return {
        "checked": answer.snapshot,
        "points": points,
        "accepted": accepted if answer.snapshot else [],
    }


def mark_snapshot(question: Expression, snapshot: Message, values: object) -> Mark:
    """Right, or wrong with one point at which it differs."""
    if isinstance(values, np.ndarray) and values.ndim == 2 and len(values) > 0:
        marks = [mark_snapshot(question, snapshot, row) for row in values]
        return min(marks, key=lambda mark: mark.credit)
    points = snapshot["points"]
    count = len(next(iter(points.values())))
    if not (isinstance(values, np.ndarray) and values.shape == (count,)):
        return wrong(question, _("{name} has no numeric values.").format(name=question.name))
    for accepted in snapshot["accepted"]:
        if same_values(accepted["values"], values, accepted["modulo"]):
            feedback = _("Right at the {count} points of this check.").format(count=count)
            feedback += f" {_(LATER)}"
            return Mark(question.id, "right", 1.0, question.points, feedback)
    expected = snapshot["accepted"][0]["values"]
    known = np.flatnonzero(np.isfinite(expected))
    differing = [i for i in known if not np.isclose(values[i], expected[i], rtol=1e-6, atol=1e-9)]
    at = differing[0] if differing else known[0]
    where = ", ".join(f"{name} = {value[at]:.4g}" for name, value in points.items())
    differs = (
        _(
            "Not equal yet. At {where} it is {value}; expected is {right} (or that plus a "
            "multiple of a period)."
        )
        if snapshot["accepted"][0]["modulo"]
        else _("Not equal yet. At {where} it is {value}; expected is {right}.")
    )
    said = differs.format(where=where, value=_number(values[at]), right=_number(expected[at]))
    found = _related(snapshot["accepted"], values)
    if found is None:
        return wrong(question, said)
    return replace(wrong(question, f"{found.sentence} {said}"), alternative=found.name)


def _related(accepted: list[Message], values: np.ndarray) -> Diagnosis | None:
    """The simplest relation between what is right at the points and what was given."""
    for relation in RELATIONS:
        for entry in accepted:
            expected = entry["values"]
            if len(np.unique(expected.round(9))) < _TELLING:
                continue
            with np.errstate(all="ignore"), suppress(TypeError):  # not for complex numbers
                if same_values(relation.change(_real(expected)), values, entry["modulo"]):
                    return relation.diagnosis
    return None


def _real(values: np.ndarray) -> np.ndarray:
    return values.real if np.isrealobj(values) or not values.imag.any() else values


def _number(value: complex) -> str:
    return f"{value.real:.6g}" if abs(value.imag) < 1e-9 else f"{value:.6g}"
