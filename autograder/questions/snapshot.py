"""What the snapshots of all kinds have in common (see `autograder.marking.snapshots`)."""

from __future__ import annotations

from autograder.language import N_
from autograder.questions.mark import Mark
from autograder.questions.question import Question

LATER = N_("The marks that count are given after you hand in, on other inputs.")


def wrong(question: Question, feedback: str) -> Mark:
    """The mark of a response that a snapshot shows to be wrong."""
    return Mark(question.id, "wrong", 0.0, question.points, feedback)
