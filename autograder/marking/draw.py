"""Makes a question ready to be put, as its kind says."""

from __future__ import annotations

import zlib
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from autograder.questions.answer import Answer
from autograder.questions.drawn import Drawn
from autograder.questions.question import Question
from autograder.questions.registry import kind_of


def draw(question: Question, answer: Answer, seed: int, root: Path) -> Drawn:
    """Draw the hidden points or inputs of a question; the same seed draws the same ones.

    Raises:
        CourseError: if the reference, cases or a mistake cannot be loaded, or the cases are
            malformed.
    """
    return kind_of(question).draw(question, answer, random_numbers(question, seed), root)


def random_numbers(question: Question, seed: int) -> np.random.Generator:
    """Where the hidden points or inputs of a question come from."""
    return np.random.default_rng([seed, zlib.crc32(question.id.encode())])


# How many sets of hidden inputs those share who hand in other work for the same time: drawing a set
# runs every reference and every mistake of the key, which is too dear to do for each student.
SETS = 2


def set_number(student: str, fingerprint: str, works: Sequence[str]) -> int:
    """Which set of hidden inputs some work of a student is marked with.

    ``works`` are the fingerprints of what the student handed in until now, in that order. The first
    work has set 0. Other work has a set that the student has met in no page of feedback before, so
    that what one says of hidden inputs is worth nothing; the same work always has the same set.
    """
    position = works.index(fingerprint) if fingerprint in works else len(works)
    if position == 0:
        return 0
    chance = zlib.crc32(f"{student}\0{fingerprint}".encode("utf-8", "surrogatepass"))
    return 1 + (position - 1) * SETS + chance % SETS


def set_of_variant(variant: int) -> int:
    """The number of the set for a variant of a question whose key is the same in all of them.

    It counts down from 0, since `set_number` counts up, and in a set of that for other work too.
    """
    return -(variant % SETS)


def seed_of_set(seed: int, number: int) -> int:
    """The seed of a set of hidden inputs in a run with some seed."""
    return seed if number == 0 else zlib.crc32(f"{seed}:{number}".encode())
