"""Were some students' numbers harder than others'? A test of equal difficulty for each question."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from autograder.course import Course
from autograder.gradebook.record import Record

SHUFFLES = 2000
FEWEST = 10  # students with a question, below which nothing is said
FEWEST_OF_ONE = 3  # with one variant, for it to be called the hardest
_SEED = 1  # the same page says the same


@dataclass(frozen=True)
class Difficulty:
    """What a class earned of one question with its several variants.

    ``chance`` is how often variants that are equally hard differ as much as these, or more, if
    their students are shuffled, and ``error`` the standard error of that. ``hardest`` are the
    numbers of the variant with the lowest mean, ``less`` how much less its students earned than
    all others, as a share of the points, from ``low`` to ``high`` in 95 of 100 cases.
    """

    question: str
    students: int
    variants: int
    chance: float
    error: float
    hardest: str = ""
    less: float = 0.0
    low: float = 0.0
    high: float = 0.0


class VariantSums:
    """Gathers what was earned by variant, one record after the other."""

    def __init__(self, course: Course) -> None:
        self._course = course
        self._earned: dict[str, tuple[list[int], list[float]]] = {}

    def add(self, record: Record) -> None:
        """Take in one submission; what was not attempted says nothing about the numbers."""
        name = record.graded.numbers_of
        if not self._course.personal or not name:
            return
        for id in self._course.varied:
            mark = record.marks.get(id)
            if mark is None or mark.status not in ("right", "partial", "wrong"):
                continue
            variants, credits = self._earned.setdefault(id, ([], []))
            variants.append(self._course.variant_of(id, name))
            credits.append(mark.credit)

    def difficulties(self) -> list[Difficulty]:
        """What there is to say of each question that varies, in the order of the course."""
        return [
            _difficulty(self._course, id, *self._earned[id])
            for id in self._course.questions
            if id in self._earned and len(self._earned[id][0]) >= FEWEST
        ]


def _difficulty(
    course: Course, id: str, variants: Sequence[int], credits: Sequence[float]
) -> Difficulty:
    groups, earned = np.unique(variants, return_inverse=True)[1], np.asarray(credits)
    counts = np.bincount(groups)
    names = np.unique(variants)
    rng = np.random.default_rng(_SEED)
    seen = _between(groups, earned, counts)
    as_far = sum(
        _between(groups, rng.permutation(earned), counts) >= seen - 1e-12 for _ in range(SHUFFLES)
    )
    chance = (as_far + 1) / (SHUFFLES + 1)
    error = math.sqrt(chance * (1 - chance) / SHUFFLES)
    found = Difficulty(id, len(earned), len(names), chance, error)
    means = np.bincount(groups, earned) / counts
    enough = (counts >= FEWEST_OF_ONE) & (counts < len(earned))
    if not enough.any():
        return found
    at = int(np.argmin(np.where(enough, means, np.inf)))
    own, others = earned[groups == at], earned[groups != at]
    less = float(others.mean() - own.mean())
    spread = 1.96 * math.sqrt(_variance_of_mean(own) + _variance_of_mean(others))
    return Difficulty(
        *(id, len(earned), len(names), chance, error, _told(course, id, int(names[at]))),
        *(less, less - spread, less + spread),
    )


def _between(groups: np.ndarray, earned: np.ndarray, counts: np.ndarray) -> float:
    """The sum of squares between the groups."""
    means = np.bincount(groups, earned) / counts
    return float((counts * (means - earned.mean()) ** 2).sum())


def _variance_of_mean(values: np.ndarray) -> float:
    return float(values.var(ddof=1) / len(values)) if len(values) > 1 else 0.0


def _told(course: Course, id: str, variant: int) -> str:
    variables = course.varied[id].variables
    assert variables is not None
    return ", ".join(f"{name} = {value:g}" for name, value in variables.numbers(variant).items())
