"""A value, compared with the known values of the answer."""

from __future__ import annotations

from decimal import Decimal

from autograder.exchange.messages import Message
from autograder.kinds.number.answer import NumberAlternative, NumberAnswer
from autograder.kinds.number.diagnosis import diagnose_number
from autograder.kinds.number.question import Number
from autograder.language import _
from autograder.questions.drawn import NOTHING_AROUND, Around
from autograder.questions.mark import Mark, status_for

_SINGLE_PRECISION = 1e-6  # relative, of a number that was computed with it


def mark_number(
    question: Number,
    answer: NumberAnswer,
    value: int | float,
    understood: str = "",
    around: Around = NOTHING_AROUND,
) -> Mark:
    """The first alternative within its tolerance decides.

    ``understood`` is how the response looked before anything hidden was sent to its process, and
    that is what the student is shown: the value itself may by now be a hidden input, kept by one
    function and given back by another object, unless it is a value that the key knows.
    """
    known: Message = {
        "explanation": answer.explanation,
        "understood": _as_number(understood, question),
    }
    for alternative in answer.alternatives:
        if abs(value - alternative.value) <= _tolerance(question, alternative, value):
            known["understood"] = known["understood"] or question.in_unit(value)
            return Mark(
                question.id,
                status_for(alternative.credit),
                alternative.credit,
                question.points,
                alternative.feedback or _("Right."),
                alternative=alternative.name,
                **known,
            )
    if question.integer and value != round(value):
        feedback = _("A whole number is asked for. Decide whether to round up or down, and why.")
    else:
        feedback = _(
            "That is not the value asked for. Read again what is given and what is asked; "
            "a hint may help."
        )
    name = None
    known["evidence"] = f"value {value:.10g}"
    if (found := diagnose_number(question, answer, value, around)) is not None:
        name, feedback = found.name, found.sentence
    known["understood"] = known["understood"] or understood
    return Mark(question.id, "wrong", 0.0, question.points, feedback, name, **known)


def _tolerance(question: Number, alternative: NumberAlternative, value: int | float) -> float:
    """How far a value may be from an alternative's.

    As many decimals as are asked for may be rounded. Whoever gives more of them has to be right to
    these, by at most one in the last, as far as the key itself and single precision go. A mistake
    that gives no whole number is given as one where one is asked for, rounded.
    """
    if alternative.tolerance is not None:
        return alternative.tolerance
    if (
        question.integer
        and alternative.is_mistake
        and alternative.value != round(alternative.value)
    ):
        return 0.5
    if question.decimals is None or alternative.is_mistake:
        return question.tolerance
    coarser = max(_last_place(value), _last_place(alternative.value))
    finest = max(coarser * (1 + 1e-9), _SINGLE_PRECISION * abs(alternative.value))
    return min(question.tolerance, finest)


def _last_place(value: int | float) -> float:
    """What one in the last place is worth, of a finite number as it is written: 0.01 of 0.18.

    And of ``1 - 0.82``, which a computer rounds to 0.18000000000000005.
    """
    exponent = Decimal(f"{float(value):.12g}").normalize().as_tuple().exponent
    return float(10.0 ** int(exponent))


def _as_number(understood: str, question: Number) -> str:
    """The text as a number with its unit; nothing if it is none, such as sympy's ``log(3)``."""
    try:
        return question.in_unit(float(understood))
    except ValueError:
        return ""
