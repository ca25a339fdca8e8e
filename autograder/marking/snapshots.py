"""Snapshots: how a student bundle checks function and expression questions without any key.

A snapshot holds inputs that students may see and what the right response gives for them, as plain
numbers in ``notebooks/snapshots/CHAPTER.json``. `autograder.release` takes them.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from autograder.course import Course
from autograder.course.questions import Question
from autograder.errors import CourseError
from autograder.kinds.expression.marking import same_values
from autograder.kinds.function.marking import agrees, close
from autograder.marking.mark import Mark, Part, not_attempted, stopped
from autograder.sandbox.inside.evaluate import REASONS

SNAPSHOTS = Path("notebooks/snapshots")
_SHORT = 160  # characters of an input or a value that a hint may show
_LATER = "The marks that count are given after you hand in, on other inputs."


class SnapshotMarker:
    """Marks what the snapshots tell; everything else is recorded."""

    def __init__(self, course: Course) -> None:
        self._course = course
        self._snapshots: dict[str, dict[str, Any]] = {}
        for path in sorted((course.root / SNAPSHOTS).glob("*.json")):
            try:
                self._snapshots |= unpack(json.loads(path.read_text(encoding="utf-8")))
            except (OSError, ValueError, TypeError, KeyError):
                raise CourseError(
                    f"{path} is damaged; take it from the course's download again."
                ) from None

    def can_mark(self, id: str) -> bool:
        """Whether a response to a question can be marked, or only recorded."""
        snapshot = self._snapshots.get(id)
        return snapshot is not None and bool(snapshot["checked"])

    def probe(self, id: str) -> dict[str, Any]:
        """What the kernel has to evaluate for a question."""
        kind = self._course.question(id).kind
        snapshot = self._snapshots.get(id)
        if kind == "function":
            cases = snapshot["cases"] if snapshot else []
            sent = [{"args": c["args"], "kwargs": c.get("kwargs", {})} for c in cases]
            return {"kind": kind, "cases": sent}
        if kind == "expression":
            return {"kind": kind, "points": snapshot["points"] if snapshot else {}}
        return {"kind": kind}

    def mark(self, id: str, response: Any, understood: str = "") -> Mark:
        """Mark what came back for the probe."""
        question = self._course.question(id)
        snapshot = self._snapshots.get(id)
        if not isinstance(response, dict):
            return stopped(question, "recorded")
        state, reason = response.get("state"), str(response.get("reason", ""))
        if state == "not attempted":
            return not_attempted(question)
        if snapshot is None or not snapshot["checked"]:
            return stopped(question, "recorded")
        if state == "raised":
            return _wrong(question, f"Evaluating {question.name} raises {response.get('error')}.")
        if state != "given":
            said = REASONS.get(reason, "it could not be read")
            return _wrong(question, f"{question.name} cannot be checked: {said}.")
        if question.kind == "function":
            return _function(question, snapshot, response.get("outcomes", []))
        return _expression(question, snapshot, response.get("values"))


def _function(question: Question, snapshot: dict[str, Any], outcomes: list[Any]) -> Mark:
    cases = snapshot["cases"]
    verdicts = [
        agrees(close, case, case["expected"], outcome)
        for case, outcome in zip(cases, outcomes, strict=True)
    ]
    kinds = list(dict.fromkeys(case["name"] for case in cases))
    parts = tuple(
        Part(
            kind,
            all(v for v, case in zip(verdicts, cases, strict=True) if case["name"] == kind),
            "",
        )
        for kind in kinds
    )
    if all(verdicts):
        said = f"Right on the {len(cases)} examples of this check. {_LATER}"
        return Mark(question.id, "right", 1.0, question.points, said, parts=parts)
    first = verdicts.index(False)
    failing = ", ".join(part.label for part in parts if not part.right)
    hint = _hint(question, cases[first], outcomes[first])
    if snapshot["forgiving"] and not any(map(_is_wrong, cases, outcomes)):
        said = f"Recorded. It differs from one right result, and may be right all the same. {hint}"
        return stopped(question, "recorded", said)
    said = f"Not yet right for: {failing}. {hint}"
    return Mark(question.id, "wrong", 0.0, question.points, said, parts=parts)


def _is_wrong(case: dict[str, Any], outcome: Any) -> bool:
    """Whether an outcome is nothing like the right one, or that of a known mistake."""
    if not (isinstance(outcome, dict) and "value" in outcome and "value" in case["expected"]):
        return True
    return not _alike(case["expected"]["value"], outcome["value"]) or any(
        agrees(close, case, wrong, outcome) for wrong in case["wrong"]
    )


def _alike(expected: Any, actual: Any) -> bool:
    """Whether a value is of the expected one's make: numbers where numbers are, lists for lists."""
    try:
        right, given = np.asarray(expected), np.asarray(actual)
    except ValueError:  # lists of unequal length
        return isinstance(expected, list) and isinstance(actual, list)
    if right.dtype.kind in "iuf":
        finite = given.dtype.kind in "iuf" and bool(np.isfinite(given).all())
        return finite and right.ndim == given.ndim
    return isinstance(actual, type(expected))


def _hint(question: Question, case: dict[str, Any], outcome: Any) -> str:
    """One failing case, in numbers if they are few."""
    arguments = [_shown(value) for value in case["args"]]
    arguments += [f"{name}={_shown(value)}" for name, value in case.get("kwargs", {}).items()]
    call = f"{question.name}({', '.join(arguments)})"
    if isinstance(outcome, dict) and "raised" in outcome:
        gave = f"raises {outcome['raised']}"
    elif isinstance(outcome, dict) and "value" in outcome:
        gave = f"gives {_shown(outcome['value'])}"
    else:
        reason = str(outcome.get("unusable")) if isinstance(outcome, dict) else ""
        gave = f"cannot be used: {REASONS.get(reason, REASONS['not plain'])}"
    expected = case["expected"]
    right = _shown(expected["value"]) if "value" in expected else f"an {expected.get('raised')}"
    if len(call) > _SHORT:
        call = f"For {case['name']}, {question.name}"
    return f"{call} {gave}; expected is {right}."


def _shown(value: Any) -> str:
    with np.printoptions(precision=6, suppress=True, threshold=20):
        if isinstance(value, np.ndarray):
            text = f"np.array({np.array2string(value, separator=', ')})"
        elif isinstance(value, list) and all(isinstance(v, int | float) for v in value):
            text = "[" + ", ".join(f"{v:.6g}" for v in value) + "]"
        else:
            text = f"{value:.8g}" if isinstance(value, float) else repr(value)
    text = " ".join("".join(c if c.isprintable() else " " for c in text).split())
    return text if len(text) <= _SHORT else text[: _SHORT - 1] + "…"


def _expression(question: Question, snapshot: dict[str, Any], values: Any) -> Mark:
    points = snapshot["points"]
    count = len(next(iter(points.values())))
    if not (isinstance(values, np.ndarray) and values.shape == (count,)):
        return _wrong(question, f"{question.name} has no numeric values.")
    for accepted in snapshot["accepted"]:
        if same_values(accepted["values"], values, accepted["modulo"]):
            said = f"Right at the {count} points of this check. {_LATER}"
            return Mark(question.id, "right", 1.0, question.points, said)
    expected = snapshot["accepted"][0]["values"]
    known = np.flatnonzero(np.isfinite(expected))
    wrong = [i for i in known if not np.isclose(values[i], expected[i], rtol=1e-6, atol=1e-9)]
    at = wrong[0] if wrong else known[0]
    where = ", ".join(f"{name} = {value[at]:.4g}" for name, value in points.items())
    return _wrong(
        question,
        f"Not equal yet. At {where} it is {_number(values[at])}; "
        f"expected is {_number(expected[at])}"
        + (" (or that plus a multiple of a period)." if snapshot["accepted"][0]["modulo"] else "."),
    )


def _number(value: complex) -> str:
    return f"{value.real:.6g}" if abs(value.imag) < 1e-9 else f"{value:.6g}"


def _wrong(question: Question, feedback: str) -> Mark:
    return Mark(question.id, "wrong", 0.0, question.points, feedback)


def pack(value: Any) -> Any:
    """Plain data with arrays as JSON."""
    if isinstance(value, np.ndarray):
        if value.dtype.kind == "c":
            return {"complex": [value.real.tolist(), value.imag.tolist()]}
        return {"array": value.tolist(), "dtype": value.dtype.str, "shape": list(value.shape)}
    if isinstance(value, dict):
        return {str(key): pack(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [pack(entry) for entry in value]
    if isinstance(value, np.generic):
        return value.item()
    return value


def unpack(value: Any) -> Any:
    """What `pack` made of plain data, as it was; named tuples are lists."""
    if isinstance(value, dict):
        if value.keys() == {"array", "dtype", "shape"}:
            return np.array(value["array"], dtype=value["dtype"]).reshape(value["shape"])
        if value.keys() == {"complex"}:
            real, imaginary = value["complex"]
            return np.array(real) + 1j * np.array(imaginary)
        return {key: unpack(entry) for key, entry in value.items()}
    if isinstance(value, list):
        return [unpack(entry) for entry in value]
    return value
