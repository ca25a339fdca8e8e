"""Cases that students may see, in numbers: what their function gives, and what is right."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from autograder.exchange.messages import Values
from autograder.exchange.reasons import REASONS
from autograder.kinds.function.question import Function

_SHORT = 160  # characters of an input or a value that a hint may show
_MOST = 3  # cases that are shown, each of another kind of input


def hints(
    question: Function,
    cases: Sequence[Values],
    expected: Sequence[Mapping[str, object]],
    outcomes: Sequence[object],
    failing: Sequence[int],
) -> str:
    """The first failing case of each kind of input, of few kinds."""
    first: dict[str, int] = {}
    for index in failing:
        first.setdefault(str(cases[index]["name"]), index)
    shown = list(first.values())[:_MOST]
    return " ".join(hint(question, cases[i], expected[i], outcomes[i]) for i in shown)


def hint(question: Function, case: Values, expected: Mapping[str, object], outcome: object) -> str:
    """One failing case, in numbers if they are few."""
    arguments = [_shown(value) for value in case["args"]]
    arguments += [f"{name}={_shown(value)}" for name, value in case.get("kwargs", {}).items()]
    call = f"{question.name}({', '.join(arguments)})"
    if len(call) > _SHORT:
        call = f"For {case['name']}, {question.name}"
    right = _shown(expected["value"]) if "value" in expected else _an(f"{expected.get('raised')}")
    if isinstance(outcome, dict) and "raised" in outcome:
        return f"{call} raises {outcome['raised']}; expected is {right}."
    if not (isinstance(outcome, dict) and "value" in outcome):
        reason = str(outcome.get("unusable")) if isinstance(outcome, dict) else ""
        why = REASONS.get(reason, REASONS["not plain"])
        return f"{call} cannot be used: {why}; expected is {right}."
    gave = f"{call} gives {_shown(outcome['value'])}"
    if "value" in expected and (asked := _other_draws(case, outcome)):
        return f"{gave} and draws {outcome['drawn']} random numbers; expected is {asked}."
    if "changed" in outcome and "changed" not in expected:
        gave += " and changes its input"
    return f"{gave}; expected is {right}."


def _other_draws(case: Values, outcome: Mapping[str, object]) -> str:
    """How many numbers a function should draw with the generator it was given, if it does not."""
    drawn = outcome.get("drawn")
    if "draws" not in case or not isinstance(drawn, int):
        return ""
    low, high = case["draws"]
    if low <= drawn <= high:
        return ""
    return f"{low} or more" if math.isinf(high) else f"at least {low} and at most {high}"


def _entry(value: object) -> str:
    if isinstance(value, list):
        return "[" + ", ".join(map(_entry, value)) + "]"
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, np.ndarray):
        return f"array({np.array2string(value, separator=', ')})"
    return repr(value)


def _an(error: str) -> str:
    return f"an {error}" if error[:1] in "AEIOU" else f"a {error}"


def _shown(value: object) -> str:
    with np.printoptions(precision=6, suppress=True, threshold=20):
        if isinstance(value, np.ndarray):
            text = f"np.array({np.array2string(value, separator=', ')})"
        elif isinstance(value, list):
            text = "[" + ", ".join(map(_entry, value)) + "]"
        else:
            text = f"{value:.8g}" if isinstance(value, float) else repr(value)
    text = " ".join("".join(c if c.isprintable() else " " for c in text).split())
    return text if len(text) <= _SHORT else text[: _SHORT - 1] + "…"
