"""A function, compared case by case with what the reference returns, and with known mistakes."""

from __future__ import annotations

import builtins
import zlib
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from autograder.diagnosis.relations import Diagnosis
from autograder.exchange.messages import Value
from autograder.exchange.why_unusable import REASONS
from autograder.kinds.function.answer import FunctionAlternative, FunctionAnswer
from autograder.kinds.function.credit import partial_credit
from autograder.kinds.function.diagnosis import diagnose_function
from autograder.kinds.function.drawn_outcomes import shown_outcome
from autograder.kinds.function.draws import drew
from autograder.kinds.function.hints import hints
from autograder.kinds.function.question import Function
from autograder.language import _
from autograder.questions.mark import NO_VALUE, Mark, Part, status_for

Outcome = dict[str, object]
Compare = Callable[[dict[str, object], object, object], bool]


class Explains(Protocol):
    """What knows how the reference behaves when it is changed a little."""

    def explain(
        self, right: Sequence[Outcome], outcomes: Sequence[object], verdicts: Sequence[bool]
    ) -> Diagnosis | None:
        """The change with which the reference gives these outcomes, if there is one."""


@dataclass(frozen=True)
class Expected:
    """What the trusted side knows of a function question: cases and their right outcomes.

    An outcome is ``{"value": ...}``, ``{"raised": class}`` or ``{"unusable": reason}``. A value
    may come with ``"changed"``, if an input was changed in place, with ``"drawn"``, how many
    random numbers were taken, and with ``"sampled"``, the size and the number of the samples.
    """

    cases: Sequence[dict[str, Value]]
    outcomes: Sequence[Outcome]
    compare: Compare
    mistakes: Sequence[tuple[FunctionAlternative, Sequence[Outcome]]]
    hypotheses: Explains | None = None


def mark_function(
    question: Function,
    answer: FunctionAnswer,
    expected: Expected,
    outcomes: Value,
    tells: bool = True,
) -> Mark:
    """Right on every case, or like a known mistake, or right on some kinds of input.

    A response that matches no mistake earns its `partial_credit`. ``outcomes`` come from the
    student's process and are not trusted. Unless it ``tells``, feedback says of hidden inputs no
    more than that some gave no value: each word more could be chosen to carry one of them out.
    """
    tells = tells or all(case.get("public") for case in expected.cases)
    if not (isinstance(outcomes, list) and len(outcomes) == len(expected.cases)):
        outcomes = [{"unusable": "not plain"}] * len(expected.cases)
    verdicts = [
        agrees(expected.compare, case, right, actual)
        for case, right, actual in zip(expected.cases, expected.outcomes, outcomes, strict=True)
    ]
    kinds: dict[str, list[int]] = {}
    for index, case in enumerate(expected.cases):
        kinds.setdefault(str(case["name"]), []).append(index)
    parts = tuple(
        Part(
            kind,
            all(verdicts[i] for i in indices),
            _what_happened(outcomes, indices) if tells else "",
        )
        for kind, indices in kinds.items()
    )
    # Without a picture the first case was not asked alone.
    shown = shown_outcome(expected.cases, outcomes) if answer.picture else None
    known: dict[str, Value] = {"parts": parts, "explanation": answer.explanation, "shown": shown}
    if all(verdicts):
        feedback = _("Right on all {count} kinds of input.").format(count=len(kinds))
        return Mark(question.id, "right", 1.0, question.points, feedback, "right", **known)
    for mistake, behaviour in expected.mistakes:
        if behaves_like(expected, behaviour, outcomes, verdicts):
            return Mark(
                question.id,
                status_for(mistake.credit),
                mistake.credit,
                question.points,
                mistake.feedback,
                alternative=mistake.name,
                **known,
            )
    right = sum(part.right is True for part in parts)
    credit = partial_credit(
        expected.cases,
        expected.outcomes,
        verdicts,
        lambda i, outcome: agrees(
            expected.compare, expected.cases[i], expected.outcomes[i], outcome
        ),
        max((mistake.credit for mistake in answer.alternatives), default=1.0),
    )
    failing = [f"{part.label}{part.feedback}" for part in parts if not part.right]
    feedback = _("Right on {right} of {count} kinds of input. Not yet on: {failing}.").format(
        right=right, count=len(parts), failing="; ".join(failing)
    )
    if not tells and any(
        not isinstance(outcome, dict) or "value" not in outcome or "changed" in outcome
        for outcome, verdict in zip(outcomes, verdicts, strict=True)
        if not verdict
    ):
        feedback = f"{feedback} {_(NO_VALUE)}"
    if all(isinstance(outcome, dict) and "raised" in outcome for outcome in outcomes):
        name = _known_error(outcomes[0]["raised"]) if tells else _("an exception")
        feedback = _("It raises {name} on every input. Try it on a small example first.").format(
            name=name
        )
        return Mark(question.id, "error", 0.0, question.points, feedback, **known)
    diagnosed = None
    try:
        found = _diagnosis(expected, outcomes, verdicts)
    except Exception:  # what a student returned may be anything, and need not have a name
        found = None
    if found is not None:
        diagnosed, feedback = found.name, f"{found.sentence} {feedback}"
        known["evidence"] = found.evidence
    elif seen := _smallest_seen(answer, expected, verdicts, tells):
        with suppress(Exception):  # what cannot be shown need not be
            example = hints(question, expected.cases, expected.outcomes, outcomes, seen)
            feedback = f"{feedback} {_('For example:')} {example}"
    if found is None:
        with suppress(Exception):  # anything may be in it
            known["evidence"] = fingerprint(outcomes)
    return Mark(
        question.id, status_for(credit), credit, question.points, feedback, diagnosed, **known
    )


def _smallest_seen(
    answer: FunctionAnswer, expected: Expected, verdicts: Sequence[bool], tells: bool
) -> list[int]:
    """The cases that are wrong and whose input and result students may see, the smallest first.

    What was returned for a public input after hidden ones had been sent could carry one of those
    out, so that on a page of feedback only the first case is shown, which was asked alone.
    """
    seen = [i for i, case in enumerate(expected.cases) if case.get("public") and not verdicts[i]]
    if not tells:
        seen = [i for i in seen if i == 0 and answer.picture]
    return sorted(seen, key=lambda i: _size(expected.cases[i]["args"]))


def fingerprint(outcomes: object) -> str:
    """A word that is the same for responses with the same outcomes, to six digits.

    Nameless responses of a class with one word have one mistake in common.
    """
    return f"outcomes {zlib.crc32(_rounded(outcomes).encode()):08x}"


def _rounded(value: object) -> str:
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, dict):
        return "".join(f"{key}:{_rounded(entry)}," for key, entry in sorted(value.items()))
    if isinstance(value, list):
        return "[" + ",".join(map(_rounded, value)) + "]"
    return f"{value + 0.0:.6g}" if isinstance(value, int | float) else repr(value)[:80]


def _size(value: object) -> int:
    if isinstance(value, np.ndarray):
        return value.size
    return sum(map(_size, value)) if isinstance(value, list) else 1


def _diagnosis(
    expected: Expected, outcomes: Sequence[object], verdicts: Sequence[bool]
) -> Diagnosis | None:
    def same(case: Mapping[str, object], changed: object, value: object) -> bool:
        return close({}, changed, value) or expected.compare(dict(case), changed, value)

    def counts_as_right(case: Mapping[str, object], right: object, value: object) -> bool:
        return expected.compare(dict(case), right, value)

    found = diagnose_function(
        expected.cases, expected.outcomes, outcomes, verdicts, same, counts_as_right
    )
    if found is None and expected.hypotheses is not None:
        found = expected.hypotheses.explain(expected.outcomes, outcomes, verdicts)
    return found


def behaves_like(
    expected: Expected,
    mistake: Sequence[Outcome],
    outcomes: Sequence[object],
    verdicts: Sequence[bool],
) -> bool:
    """Whether outcomes are those of a mistake: wrong where it is wrong, and in the same way."""
    for case, right, wrong, actual, verdict in zip(
        expected.cases, expected.outcomes, mistake, outcomes, verdicts, strict=True
    ):
        if agrees(expected.compare, case, right, wrong) != verdict:
            return False
        if not verdict and not agrees(expected.compare, case, wrong, actual):
            return False
    return True


def agrees(compare: Compare, case: dict[str, object], expected: Outcome, actual: object) -> bool:
    """Whether an outcome counts as the expected one; anything malformed does not."""
    if not isinstance(actual, dict):
        return False
    try:
        if "value" not in expected:
            return "value" not in actual and _same_failure(expected, actual)
        if "may_raise" in case and _same_failure({"raised": case["may_raise"]}, actual):
            return True
        if "value" not in actual or ("changed" in actual) != ("changed" in expected):
            return False
        if drew(case, actual) != drew(case, expected):
            return False
        return bool(compare(case, expected["value"], actual["value"]))
    except Exception:
        # The value is a student's and may be anything; one that compare cannot read is not equal.
        return False


def _same_failure(expected: Outcome, actual: dict[str, object]) -> bool:
    """Whether a call fails as it should; a more special exception is one of the general class."""
    right, given = expected.get("raised"), actual.get("raised")
    if not (isinstance(right, str) and isinstance(given, str)):
        return bool(actual == expected)
    if given == "LinAlgError":  # NumPy's, a ValueError
        return right in ("LinAlgError", "ValueError", "Exception")
    kind, general = getattr(builtins, given, None), getattr(builtins, right, None)
    if isinstance(kind, type) and isinstance(general, type):
        return issubclass(kind, general)
    return given == right


def close(case: dict[str, object], expected: object, actual: object) -> bool:
    """The default comparison: equal structure, numbers equal to six digits."""
    return _same(expected, actual, 1e-6, 1e-9)


def nearly(case: dict[str, object], expected: object, actual: object) -> bool:
    """As `close`, for numbers that were computed with single precision on the way."""
    return _same(expected, actual, 1e-5, 1e-6)


def _same(expected: object, actual: object, relative: float, absolute: float) -> bool:
    """Equal structure, and numbers that differ by no more; ``absolute`` is of the largest."""
    if isinstance(expected, dict):
        return (
            isinstance(actual, dict)
            and expected.keys() == actual.keys()
            and all(_same(expected[key], actual[key], relative, absolute) for key in expected)
        )
    if isinstance(expected, str | bool) or expected is None:
        return type(actual) is type(expected) and bool(actual == expected)
    if isinstance(expected, list) and not _is_numeric(expected):
        return (
            isinstance(actual, list)
            and len(actual) == len(expected)
            and all(_same(e, a, relative, absolute) for e, a in zip(expected, actual, strict=True))
        )
    if isinstance(expected, int) and isinstance(actual, int):
        return expected == actual  # exact, and of any length
    expected, actual = _as_float(expected), _as_float(actual)
    if not (_is_numeric(expected) and _is_numeric(actual)):
        return False
    right, given = np.asarray(expected), np.asarray(actual)
    if right.shape != given.shape:
        return False
    if right.dtype.kind in "iub" and given.dtype.kind in "iub":
        return bool(np.array_equal(right, given))
    if right.dtype.kind in "iu":  # one more is another number, however large it is
        return bool(np.allclose(given, right, rtol=0, atol=1e-6))
    size = float(np.max(np.abs(right), initial=0.0, where=np.isfinite(right)))
    least = absolute * max(size, 1e-3)
    return bool(np.allclose(given, right, rtol=relative, atol=least, equal_nan=True))


def _as_float(value: object) -> object:
    """An integer too long for NumPy as a float, if it is not too long for that."""
    if not isinstance(value, int) or value.bit_length() < 64:
        return value
    try:
        return float(value)
    except OverflowError:
        return value


def _is_numeric(value: object) -> bool:
    try:
        return np.asarray(value).dtype.kind in "biufc"
    except (ValueError, OverflowError):
        return False


def _what_happened(outcomes: Sequence[object], indices: Sequence[int]) -> str:
    for index in indices:
        outcome = outcomes[index]
        if isinstance(outcome, dict) and "raised" in outcome:
            sentence = _("it raises {name}").format(name=_known_error(outcome["raised"]))
            return f" ({sentence})"
        if isinstance(outcome, dict) and "unusable" in outcome:
            reason = outcome["unusable"]
            known = isinstance(reason, str) and reason in REASONS
            return f" ({_(REASONS[reason if known else 'not plain'])})"
        if isinstance(outcome, dict) and "changed" in outcome:
            return f" ({_('it changes its input in place; work on a copy')})"
    return ""


def _known_error(name: Value) -> str:
    """Only names that Python itself defines are repeated: any other could carry a hidden input."""
    known = isinstance(name, str) and (hasattr(builtins, name) or name == "LinAlgError")
    return name if known else _("an exception")
