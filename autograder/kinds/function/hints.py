"""Cases that students may see, in numbers: what their function gives, and what is right."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from autograder.exchange.messages import Values
from autograder.exchange.why_unusable import REASONS
from autograder.kinds.function.draws import other_draws, other_samples
from autograder.kinds.function.question import Function
from autograder.language import _

_SHORT = 160  # characters of an input or a value that a hint may show
_MOST = 3  # cases that are shown, each of another kind of input


def hints(
    question: Function,
    cases: Sequence[Values],
    expected: Sequence[Mapping[str, object]],
    outcomes: Sequence[object],
    failing: Sequence[int],
) -> str:
    """The first failing case of each kind of input, of few kinds; of one exception the first."""
    first: dict[str, int] = {}
    raised: set[object] = set()
    for index in failing:
        outcome = outcomes[index]
        error = outcome.get("raised") if isinstance(outcome, dict) else None
        if error is None or error not in raised:
            first.setdefault(str(cases[index]["name"]), index)
        raised.add(error)
    shown = list(first.values())[:_MOST]
    return " ".join(hint(question, cases[i], expected[i], outcomes[i]) for i in shown)


def hint(question: Function, case: Values, expected: Mapping[str, object], outcome: object) -> str:
    """One failing case, in numbers if they are few."""
    arguments = [_shown(value) for value in case["args"]]
    arguments += [f"{name}={_shown(value)}" for name, value in case.get("kwargs", {}).items()]
    call = f"{question.name}({', '.join(arguments)})"
    if len(call) > _SHORT:
        call = _("For {case}, {function}").format(case=case["name"], function=question.name)
    fields: dict[str, object] = {}
    right = _shown(expected["value"]) if "value" in expected else _an(f"{expected.get('raised')}")
    if isinstance(outcome, dict) and "raised" in outcome:
        gave = _("{call} raises {error}; expected is {right}.")
        fields["error"] = outcome["raised"]
    elif not (isinstance(outcome, dict) and "value" in outcome):
        reason = str(outcome.get("unusable")) if isinstance(outcome, dict) else ""
        gave = _("{call} cannot be used: {why}; expected is {right}.")
        fields["why"] = _(REASONS.get(reason, REASONS["not plain"]))
    else:
        gave = _("{call} gives {value}; expected is {right}.")
        fields["value"] = _shown(outcome["value"])
        # Where the value is as it should be, something else is not.
        if "value" in expected and (asked := other_draws(case, outcome)):
            gave = _("{call} gives {value} and draws {count} random numbers; expected is {right}.")
            fields["count"], right = outcome["drawn"], asked
        elif "value" in expected and (asked := other_samples(case, outcome)):
            gave = _("{call} gives {value} and draws {count} samples; expected is {right}.")
            fields["count"], right = outcome["sampled"][1], asked
        elif "changed" in outcome and "changed" not in expected:
            gave = _("{call} gives {value} and changes its input; expected is {right}.")
    return gave.format(call=call, right=right, **fields)


def _entry(value: object) -> str:
    if isinstance(value, list):
        return "[" + ", ".join(map(_entry, value)) + "]"
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, np.ndarray):
        return f"array({np.array2string(value, separator=', ')})"
    return repr(value)


def _an(error: str) -> str:
    sentence = _("an {error}") if error[:1] in "AEIOU" else _("a {error}")
    return sentence.format(error=error)


def _shown(value: object) -> str:
    with np.printoptions(precision=6, suppress=True, threshold=20):
        if isinstance(value, np.ndarray):
            text = f"np.array({np.array2string(value, separator=', ')})"
        elif isinstance(value, list):
            text = "[" + ", ".join(map(_entry, value)) + "]"
        elif isinstance(value, dict) and value.keys() == {"rng"}:  # as a student can type it
            text = f"np.random.default_rng({value['rng']!r})"
        else:
            text = f"{value:.8g}" if isinstance(value, float) else repr(value)
    text = " ".join("".join(c if c.isprintable() else " " for c in text).split())
    return text if len(text) <= _SHORT else text[: _SHORT - 1] + "…"
