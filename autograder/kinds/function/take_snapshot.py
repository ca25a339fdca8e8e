"""Takes the snapshot of a function question: examples with their right outcomes.

Taken are the public cases, and for each known mistake that they do not tell from the right response
one more case that does. Such a case is drawn at random for the snapshot alone, so it is none of the
inputs that grade; a hidden case that is the same in every draw is never used.

A check in the bundle compares numbers and has no other code. Where the key's own comparison
forgives more (indices in any order, a normal turned round), the snapshot says so and holds what the
known mistakes give: what equals one of those is wrong, and so is what is far off where that is
known to be refused (`autograder.kinds.function.snapshot_tolerances`); any other difference is left
open. Where the key also takes what was computed with single precision on the way, as by OpenCV, so
does the check.

Mistakes that are public are named, with their feedback, by what they give on these cases; where two
of them give the same, one more case tells them apart.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

import numpy as np

from autograder.exchange.messages import Value
from autograder.kinds.function.answer import FunctionAnswer
from autograder.kinds.function.marking import Expected, agrees, close
from autograder.kinds.function.snapshot_tolerances import changed_throughout, far_off
from autograder.questions.json_arrays import pack


def take_snapshot(
    answer: FunctionAnswer, drawn: Expected, again: Expected
) -> tuple[dict[str, Value], list[str]]:
    """The cases that students may see, and the mistakes that they do not tell apart.

    ``again`` is another draw: a hidden case that stands in both is never used.
    """
    chosen = [index for index, case in enumerate(drawn.cases) if case.get("public")]
    missed = []
    for mistake, outcomes in drawn.mistakes:
        if any(_differs(drawn, index, outcomes) for index in chosen):
            continue
        telling = [
            index
            for index, case in enumerate(drawn.cases)
            if not _is_fixed(case, again.cases) and _differs(drawn, index, outcomes)
        ]
        if telling:
            chosen.append(telling[0])
        else:
            missed.append(mistake.name)
    named = [(m, given) for m, given in drawn.mistakes if m.in_bundle and answer.snapshot]
    for (_, one), (_, other) in combinations(named, 2):
        if all(_is_same(drawn, index, one, other) for index in chosen):
            chosen += [
                index
                for index, case in enumerate(drawn.cases)
                if not _is_fixed(case, again.cases) and not _is_same(drawn, index, one, other)
            ][:1]
    if not chosen:  # at least something to call a stub with
        chosen = [i for i, case in enumerate(drawn.cases) if not _is_fixed(case, again.cases)][:1]
    forgiving = any(forgives(drawn, index) for index in chosen)
    cases = []
    for index in sorted(chosen):
        case = {k: v for k, v in drawn.cases[index].items() if k != "public"}
        case.setdefault("kwargs", {})
        if answer.snapshot:
            case["expected"] = drawn.outcomes[index]
            if forgiving:
                if (far := far_off(drawn, index)) is not None:
                    case["far"] = far
                case["wrong"] = [
                    outcomes[index]
                    for _, outcomes in drawn.mistakes
                    if _differs(drawn, index, outcomes)
                    and not _differs_in_last_digits(drawn, index, outcomes)
                ]
        cases.append(case)
    checked = answer.snapshot and bool(cases)
    near = forgiving and all(takes_single_precision(drawn, index) for index in chosen)
    snapshot = {"checked": checked, "forgiving": forgiving, "near": near, "cases": cases}
    snapshot["named"] = [
        {
            "name": mistake.name,
            "feedback": mistake.feedback,
            "outcomes": [outcomes[index] for index in sorted(chosen)],
        }
        for mistake, outcomes in named
    ]
    return snapshot, missed


def takes_single_precision(expected: Expected, index: int) -> bool:
    """Whether the key's comparison takes the right outcome with the error of single precision."""
    outcome = expected.outcomes[index]
    if "value" not in outcome:
        return True
    value = changed_throughout(
        outcome["value"],
        lambda array: array * (1 + 1e-5) if array.dtype.kind == "f" else array,
    )
    return agrees(expected.compare, expected.cases[index], outcome, {**outcome, "value": value})


def forgives(expected: Expected, index: int) -> bool:
    """Whether the key's comparison takes more than equal numbers for the right outcome of a case.

    Tried out with the right outcome in another order, turned round, turned by a full turn, and
    changed a little.
    """
    outcome = expected.outcomes[index]
    if "value" not in outcome:
        return False
    return any(
        not agrees(close, expected.cases[index], outcome, {**outcome, "value": variant})
        and agrees(expected.compare, expected.cases[index], outcome, {**outcome, "value": variant})
        for variant in _variants(outcome["value"])
    )


def _variants(value: object) -> Iterator[object]:
    for change in (
        lambda array: array[::-1] if array.ndim else array,
        lambda array: -array if array.dtype.kind == "f" else array,
        lambda array: array + 2 * np.pi if array.dtype.kind == "f" else array,
        lambda array: array * (1 + 1e-4) if array.dtype.kind == "f" else array,
        # Of a whole number with many digits the last ones may not be asked for.
        lambda array: array + np.abs(array) // 10**10 if array.dtype.kind == "i" else array,
    ):
        yield changed_throughout(value, change)
        if isinstance(value, list):
            for position, entry in enumerate(value):
                yield [*value[:position], changed_throughout(entry, change), *value[position + 1 :]]


def _differs(expected: Expected, index: int, outcomes: Sequence[object]) -> bool:
    """Whether a check that only compares numbers sees a mistake in a case."""
    return not agrees(close, expected.cases[index], expected.outcomes[index], outcomes[index])


def _is_same(
    expected: Expected, index: int, one: Sequence[object], other: Sequence[object]
) -> bool:
    """Whether two mistakes give the same for a case."""
    return agrees(close, expected.cases[index], one[index], other[index])  # type: ignore[arg-type]


def _differs_in_last_digits(expected: Expected, index: int, outcomes: Sequence[object]) -> bool:
    """Whether a mistake's whole numbers are those of what is right, to the digits of a float."""
    outcome = expected.outcomes[index]
    if "value" not in outcome:
        return False
    value = changed_throughout(outcome["value"], lambda array: array.astype(float))
    return agrees(close, expected.cases[index], {**outcome, "value": value}, outcomes[index])


def _is_fixed(case: dict[str, object], others: Sequence[dict[str, object]]) -> bool:
    """Whether a case stands with the very same inputs in another draw."""
    return any(
        close({}, pack(case["args"]), pack(other["args"]))
        and close({}, pack(case.get("kwargs", {})), pack(other.get("kwargs", {})))
        for other in others
    )
