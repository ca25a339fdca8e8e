"""How a student bundle checks an expression: its right values at a few points."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace

import numpy as np

from autograder.diagnosis.relations import RELATIONS, Diagnosis
from autograder.exchange.messages import Message
from autograder.kinds.expression.answer import ExpressionAlternative, ExpressionAnswer
from autograder.kinds.expression.equal_values import Points, nearly_equal, same_values
from autograder.kinds.expression.marking import POINT_COUNT
from autograder.kinds.expression.question import Expression
from autograder.language import _
from autograder.questions.key_formulas import evaluate_formula
from autograder.questions.mark import Mark
from autograder.questions.snapshot import LATER, wrong

_POINTS = 12
_TELLING = 4  # different values, for a relation to say anything


def take_snapshot(answer: ExpressionAnswer, points: Points) -> Message:
    """Some of the points, and the values there of what is right and of the public mistakes."""
    chosen = list(range(_POINTS))
    if answer.free_of:
        # Half of them again, with nothing changed but what the response must not depend on.
        half = _POINTS // 2
        chosen = [*range(half), *range(POINT_COUNT, POINT_COUNT + half)]
    points = {name: values[chosen] for name, values in points.items()}

    def at_points(entry: ExpressionAlternative) -> Message:
        values = np.broadcast_to(evaluate_formula(entry.expression, points), (len(chosen),))
        return {
            "values": values.copy(),
            "modulo": float(evaluate_formula(entry.modulo, {})) if entry.modulo else None,
            "period": (entry.modulo or "").replace("pi", "π"),
        }

    right = [entry for entry in answer.alternatives if not entry.is_mistake]
    public = [entry for entry in answer.alternatives if entry.in_bundle]
    return {
        "checked": answer.snapshot,
        "points": points,
        "accepted": [at_points(entry) for entry in right] if answer.snapshot else [],
        "named": [
            {"name": entry.name, "feedback": entry.feedback, **at_points(entry)}
            for entry in public
            if answer.snapshot
        ],
        "free_of": list(answer.free_of),
        "free_of_feedback": answer.free_of_feedback,
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
    accepted = snapshot["accepted"][0]
    expected, modulo = accepted["values"], accepted["modulo"]
    if snapshot["free_of"] and not nearly_equal(values[: count // 2], values[count // 2 :]):
        symbols = ", ".join(snapshot["free_of"])
        said = snapshot["free_of_feedback"] or _("It still depends on {symbols}.").format(
            symbols=symbols
        )
        return replace(wrong(question, said), alternative=f"depends on {symbols}")
    known = np.flatnonzero(np.isfinite(expected))
    equal = [bool(same_values(expected[[i]], values[[i]], modulo)) for i in known]
    at = known[equal.index(False)] if False in equal else known[0]
    where = ", ".join(f"{name} = {value[at]:.4g}" for name, value in points.items())
    differs = (
        _(
            "Not equal yet. At {where} it is {value}; expected is {right}, or that plus a "
            "multiple of {period}."
        )
        if modulo
        else _("Not equal yet. At {where} it is {value}; expected is {right}.")
    )
    said = differs.format(
        where=where,
        value=_number(values[at]),
        right=_number(expected[at]),
        period=accepted["period"],
    )
    if any(equal):
        right = _("It is right at {count} of the {all} points of this check.")
        said += " " + right.format(count=sum(equal), all=len(known))
    for entry in snapshot["named"]:
        if same_values(entry["values"], values, entry["modulo"]):
            mark = wrong(question, f"{entry['feedback']} {said}")
            return replace(mark, alternative=entry["name"])
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
