"""One case that students may see, in numbers: what their function gives, and what is right."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from autograder.exchange.messages import Values
from autograder.exchange.reasons import REASONS
from autograder.kinds.function.question import Function
from autograder.language import _

_SHORT = 160  # characters of an input or a value that a hint may show


def hint(question: Function, case: Values, expected: Mapping[str, object], outcome: object) -> str:
    """One failing case, in numbers if they are few."""
    arguments = [_shown(value) for value in case["args"]]
    arguments += [f"{name}={_shown(value)}" for name, value in case.get("kwargs", {}).items()]
    call = f"{question.name}({', '.join(arguments)})"
    fields: dict[str, object] = {}
    if isinstance(outcome, dict) and "raised" in outcome:
        gave = _("{call} raises {error}; expected is {right}.")
        fields["error"] = outcome["raised"]
    elif isinstance(outcome, dict) and "value" in outcome:
        gave = _("{call} gives {value}; expected is {right}.")
        fields["value"] = _shown(outcome["value"])
    else:
        reason = str(outcome.get("unusable")) if isinstance(outcome, dict) else ""
        gave = _("{call} cannot be used: {why}; expected is {right}.")
        fields["why"] = _(REASONS.get(reason, REASONS["not plain"]))
    right = _shown(expected["value"]) if "value" in expected else _an(f"{expected.get('raised')}")
    if len(call) > _SHORT:
        call = _("For {case}, {function}").format(case=case["name"], function=question.name)
    return gave.format(call=call, right=right, **fields)


def _an(error: str) -> str:
    said = _("an {error}") if error[:1] in "AEIOU" else _("a {error}")
    return said.format(error=error)


def _shown(value: object) -> str:
    with np.printoptions(precision=6, suppress=True, threshold=20):
        if isinstance(value, np.ndarray):
            text = f"np.array({np.array2string(value, separator=', ')})"
        elif isinstance(value, list) and all(isinstance(v, int | float) for v in value):
            text = "[" + ", ".join(f"{v:.6g}" for v in value) + "]"
        else:
            text = f"{value:.8g}" if isinstance(value, float) else repr(value)
    text = " ".join("".join(c if c.isprintable() else " " for c in text).split())
    return text if len(text) <= _SHORT else text[: _SHORT - 1] + "…"
