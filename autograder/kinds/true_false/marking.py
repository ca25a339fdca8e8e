"""Statements called true or false."""

from __future__ import annotations

from autograder.kinds.true_false.answer import TrueFalseAnswer
from autograder.kinds.true_false.question import TrueFalse
from autograder.kinds.true_false.response import chosen
from autograder.language import N_, _, n_
from autograder.questions.mark import Mark, Part, not_attempted, status_for, stopped


def mark_true_false(question: TrueFalse, answer: TrueFalseAnswer, response: object) -> Mark:
    """One point for each statement called right; a statement left open earns nothing.

    ``response`` is a list of True, False or None (open), one for each statement.
    """
    choices = chosen(question, response)
    if choices is None:
        return stopped(
            question,
            "unreadable",
            _("The stored response is not a list of {count} true or false.").format(
                count=len(question.statements)
            ),
        )
    if all(said is None for said in choices):
        return not_attempted(question)
    parts = []
    for number, (said, key) in enumerate(zip(choices, answer.statements, strict=True), 1):
        verdict, feedback = (
            (None, _("Not answered yet."))
            if said is None
            else (True, "")
            if said == key.truth
            else (False, key.misconception)
        )
        explanation = f"{_('True') if key.truth else _('False')}. {key.explanation}"
        label = _("Statement {number}").format(number=number)
        parts.append(Part(label, verdict, feedback, explanation))
    right = sum(part.right is True for part in parts)
    credit = right / len(parts)
    feedback = _("{right} of {count} statements right.").format(right=right, count=len(parts))
    wrong = [f"{number}" for number, part in enumerate(parts, 1) if part.right is False]
    if wrong:
        again = n_(
            "Look again at statement {numbers}.", "Look again at statements {numbers}.", len(wrong)
        )
        feedback += " " + again.format(numbers=", ".join(wrong))
    return Mark(
        question.id,
        status_for(credit),
        credit,
        question.points,
        feedback,
        alternative="right" if credit == 1 else None,
        parts=tuple(parts),
        explanation=answer.explanation,
        understood=", ".join(
            {True: N_("true"), False: N_("false"), None: "–"}[said] for said in choices
        ),
    )
