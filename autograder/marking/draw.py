"""Makes a question ready to be put, as its kind says."""

from __future__ import annotations

import zlib
from pathlib import Path

import numpy as np

from autograder.kinds.answer import Answer
from autograder.kinds.drawn import Drawn
from autograder.kinds.question import Question
from autograder.kinds.registry import kind_of


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
