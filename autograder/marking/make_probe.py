"""Makes a question ready to be put, as its kind says."""

from __future__ import annotations

import importlib
import sys
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from autograder.errors import CourseError
from autograder.kinds.answer import Answer
from autograder.kinds.question import Question
from autograder.kinds.registry import kind_of
from autograder.marking.probe import Probe


def make_probe(question: Question, answer: Answer, seed: int, root: Path) -> Probe:
    """Draw the hidden points or inputs of a question; the same seed draws the same ones.

    Raises:
        CourseError: if the reference, cases or a mistake cannot be loaded, or the cases are
            malformed.
    """
    return kind_of(question).make_probe(question, answer, random_numbers(question, seed), root)


def random_numbers(question: Question, seed: int) -> np.random.Generator:
    """Where the hidden points or inputs of a question come from."""
    return np.random.default_rng([seed, zlib.crc32(question.id.encode())])


def load_object(dotted_name: str, root: Path) -> Callable[..., Any]:
    """The function that a dotted name such as ``solutions.module:function`` stands for.

    This is the only way by which the autograder reaches a course's own code.

    Raises:
        CourseError: if there is no such module or function.
    """
    module_name, _, name = dotted_name.partition(":")
    if str(root) not in sys.path:
        sys.path.insert(0, str(root))
    try:
        loaded: Callable[..., Any] = getattr(importlib.import_module(module_name), name)
        return loaded
    except (ImportError, AttributeError, ValueError) as error:
        raise CourseError(
            f"The key names {dotted_name!r}, which cannot be loaded: {error}."
        ) from error
