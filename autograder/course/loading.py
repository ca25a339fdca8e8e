"""The course's own code, loaded by the dotted names that a key gives."""

from __future__ import annotations

import importlib
from collections.abc import Callable
from pathlib import Path

from autograder.course.own_code import OWN, put_first
from autograder.errors import CourseError
from autograder.exchange.messages import Value


def load_object(dotted_name: str, root: Path) -> Callable[..., Value]:
    """The function that a dotted name such as ``solutions.module:function`` stands for.

    This is the only way by which the autograder reaches a course's own code.

    Raises:
        CourseError: if there is no such module or function.
    """
    module_name, _, name = dotted_name.partition(":")
    put_first(root, {*OWN, module_name.partition(".")[0]} - {"autograder"})
    try:
        loaded: Callable[..., object] = getattr(importlib.import_module(module_name), name)
        return loaded
    except (ImportError, AttributeError, ValueError, SyntaxError, OSError) as error:
        raise CourseError(
            f"The key names {dotted_name!r}, which cannot be loaded: {error}."
        ) from error
