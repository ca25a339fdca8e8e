"""Statements called true or false."""

from __future__ import annotations

from autograder.kinds.mark import Mark, Part, not_attempted, status_for, stopped
from autograder.kinds.true_false.answer import TrueFalseAnswer
from autograder.kinds.true_false.question import TrueFalse
from autograder.kinds.true_false.response import chosen


def mark_true_false(question: TrueFalse, answer: TrueFalseAnswer, response: object) -> Mark:
    """One point for each statement called right; a statement left open earns nothing.

    ``response`` is a list of True, False or None (open), one for each statement.
    """
    choices = chosen(question, response)
    if choices is None:
        return stopped(
            question,
            "unreadable",
            f"The stored response is not a list of {len(question.statements)} true or false.",
        )
    if all(said is None for said in choices):
        return not_attempted(question)
    parts = []
    for number, (said, key) in enumerate(zip(choices, answer.statements, strict=True), 1):
        verdict, feedback = (
            (None, "Not answered yet.")
            if said is None
            else (True, "")
            if said == key.truth
            else (False, key.misconception)
        )
        explanation = f"{'True' if key.truth else 'False'}. {key.explanation}"
        parts.append(Part(f"Statement {number}", verdict, feedback, explanation))
    right = sum(part.right is True for part in parts)
    credit = right / len(parts)
    feedback = f"{right} of {len(parts)} statements right."
    wrong = [part.label for part in parts if part.right is False]
    if wrong:
        feedback += " Look again at " + ", ".join(label.lower() for label in wrong) + "."
    return Mark(
        question.id,
        status_for(credit),
        credit,
        question.points,
        feedback,
        alternative="right" if credit == 1 else None,
        parts=tuple(parts),
        explanation=answer.explanation,
        understood=", ".join({True: "true", False: "false", None: "–"}[said] for said in choices),
    )
