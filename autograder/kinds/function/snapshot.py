"""How a student bundle checks a function: cases with their right outcomes, for all to see."""

from __future__ import annotations

from typing import Any

import numpy as np

from autograder.exchange.reasons import REASONS
from autograder.kinds.function.marking import agrees, close
from autograder.kinds.function.question import Function
from autograder.kinds.mark import Mark, Part, stopped
from autograder.kinds.snapshot import LATER

_SHORT = 160  # characters of an input or a value that a hint may show


def mark_snapshot(question: Function, snapshot: dict[str, Any], outcomes: list[Any]) -> Mark:
    """Right, or wrong with one case that fails; left open where the key would forgive more."""
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
        feedback = f"Right on the {len(cases)} examples of this check. {LATER}"
        return Mark(question.id, "right", 1.0, question.points, feedback, parts=parts)
    first = verdicts.index(False)
    failing = ", ".join(part.label for part in parts if not part.right)
    hint = _hint(question, cases[first], outcomes[first])
    if snapshot["forgiving"] and not any(map(_is_wrong, cases, outcomes)):
        feedback = (
            f"Recorded. It differs from one right result, and may be right all the same. {hint}"
        )
        return stopped(question, "recorded", feedback)
    feedback = f"Not yet right for: {failing}. {hint}"
    return Mark(question.id, "wrong", 0.0, question.points, feedback, parts=parts)


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


def _hint(question: Function, case: dict[str, Any], outcome: Any) -> str:
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
