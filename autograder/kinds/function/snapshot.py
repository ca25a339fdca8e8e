"""How a student bundle checks a function: cases with their right outcomes, for all to see."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from autograder.diagnosis.relations import Diagnosis
from autograder.exchange.messages import Value
from autograder.kinds.function.diagnosis import diagnose_function
from autograder.kinds.function.hints import hints
from autograder.kinds.function.marking import agrees, close, nearly
from autograder.kinds.function.question import Function
from autograder.kinds.function.snapshot_tolerances import is_far
from autograder.language import _, n_
from autograder.questions.mark import Mark, Part, stopped
from autograder.questions.snapshot import LATER


def mark_snapshot(question: Function, snapshot: dict[str, Value], outcomes: list[Value]) -> Mark:
    """Right, or wrong with one case that fails; left open where the key would forgive more."""
    cases = snapshot["cases"]
    verdicts = [
        agrees(close, case, case["expected"], outcome)
        or (snapshot.get("near", False) and _is_near(case, outcome))
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
        feedback = n_(
            "Right on the example of this check.",
            "Right on the {count} examples of this check.",
            len(cases),
        ).format(count=len(cases))
        feedback += f" {_(LATER)}"
        return Mark(question.id, "right", 1.0, question.points, feedback, parts=parts)
    failing = ", ".join(part.label for part in parts if not part.right)
    right = [case["expected"] for case in cases]
    wrong = [index for index, verdict in enumerate(verdicts) if not verdict]
    example = hints(question, cases, right, outcomes, wrong)
    known = _known_mistake(cases, outcomes, verdicts, snapshot["named"])
    if known is not None:
        feedback = _("Not yet right for: {failing}.").format(failing=failing) + f" {example}"
        feedback = f"{known['feedback']} {feedback}"
        return Mark(
            question.id, "wrong", 0.0, question.points, feedback, known["name"], parts=parts
        )
    if snapshot["forgiving"] and not any(_is_wrong(cases[i], outcomes[i]) for i in wrong):
        feedback = (
            _("Recorded. It differs from one right result, and may be right all the same.")
            + f" {example}"
        )
        return stopped(question, "recorded", feedback)
    feedback = _("Not yet right for: {failing}.").format(failing=failing) + f" {example}"
    found = _diagnosis(cases, outcomes, verdicts)
    name = found.name if found else None
    if found:
        feedback = f"{found.sentence} {feedback}"
    return Mark(question.id, "wrong", 0.0, question.points, feedback, name, parts=parts)


def _known_mistake(
    cases: list[dict[str, Value]],
    outcomes: list[Value],
    verdicts: list[bool],
    named: list[dict[str, Value]],
) -> dict[str, Value] | None:
    """The public mistake that gives these outcomes: wrong where it is wrong, in the same way."""
    for mistake in named:
        theirs = mistake["outcomes"]
        if all(
            verdict == agrees(close, case, case["expected"], wrong)
            and (verdict or agrees(nearly, case, wrong, outcome))
            for case, verdict, wrong, outcome in zip(cases, verdicts, theirs, outcomes, strict=True)
        ):
            return mistake
    return None


def _diagnosis(
    cases: list[dict[str, Value]], outcomes: list[Value], verdicts: list[bool]
) -> Diagnosis | None:
    """What the response looks like on the examples, which are all that is known here."""

    def same(case: Mapping[str, Value], changed: Value, value: Value) -> bool:
        return close({}, changed, value)

    try:
        right = [case["expected"] for case in cases]
        return diagnose_function(cases, right, outcomes, verdicts, same)
    except Exception:  # what a student returned may be anything, and need not have a name
        return None


def _is_near(case: dict[str, Value], outcome: Value) -> bool:
    """Whether an outcome is the right one up to single precision, and no known mistake's."""
    return agrees(nearly, case, case["expected"], outcome) and not any(
        agrees(nearly, case, wrong, outcome) for wrong in case["wrong"]
    )


def _is_wrong(case: dict[str, Value], outcome: object) -> bool:
    """Whether an outcome is nothing like the right one, or that of a known mistake."""
    if not (isinstance(outcome, dict) and "value" in outcome and "value" in case["expected"]):
        return True
    if "far" in case and is_far(case["far"], case["expected"]["value"], outcome["value"]):
        return True
    return not _alike(case["expected"]["value"], outcome["value"]) or any(
        agrees(close, case, wrong, outcome) for wrong in case["wrong"]
    )


def _alike(expected: object, actual: object) -> bool:
    """Whether a value is of the expected one's make: numbers where numbers are, lists for lists."""
    try:
        right, given = np.asarray(expected), np.asarray(actual)
    except ValueError:  # lists of unequal length
        return isinstance(expected, list) and isinstance(actual, list)
    if right.dtype.kind in "iuf":
        finite = given.dtype.kind in "iuf" and bool(np.isfinite(given).all())
        return finite and right.ndim == given.ndim
    return isinstance(actual, type(expected))
