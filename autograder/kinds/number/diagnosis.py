"""A name for a wrong number that no mistake of the key has."""

from __future__ import annotations

import numpy as np

from autograder.kinds.number.answer import NumberAnswer
from autograder.kinds.number.question import Number
from autograder.marking.diagnosis.relations import RELATIONS, Diagnosis

_ENOUGH = 1e-4  # of the size of a number: closer than chance brings one to another


def diagnose_number(question: Number, answer: NumberAnswer, value: float) -> Diagnosis | None:
    """The simplest relation to a right value, if one holds to the digits asked for."""
    right = [entry.value for entry in answer.alternatives if not entry.is_mistake]
    for relation in RELATIONS:
        if question.integer and relation.name.startswith("rounded"):
            continue
        for expected in right:
            with np.errstate(all="ignore"):
                changed = float(relation.change(np.asarray(expected, dtype=float)))
            near = question.tolerance if question.integer else _ENOUGH * abs(changed)
            differs = abs(changed - expected) > 4 * max(near, question.tolerance)
            if np.isfinite(changed) and differs and abs(changed - value) <= near:
                return Diagnosis(relation.name, relation.sentence)
    return None
