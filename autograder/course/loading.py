"""The course's own code, loaded by the dotted names that a key gives."""

from __future__ import annotations

import importlib
import inspect
import sys
from collections.abc import Callable
from difflib import get_close_matches
from pathlib import Path

from autograder.course.folders import ANSWERS
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
            f"The key names {dotted_name!r}{_where(dotted_name, root)}, which cannot be loaded: "
            f"{error}{_meant(module_name, name)}."
        ) from error


def place_of(function: Callable[..., Value], root: Path) -> str:
    """The file and the line of a function of the course, in brackets; empty if unknown."""
    try:
        file, (_, line) = inspect.getsourcefile(function), inspect.getsourcelines(function)
        return f" ({Path(file or '').resolve().relative_to(root).as_posix()}, line {line})"
    except (OSError, TypeError, ValueError):  # not written in a file, or not of the course
        return ""


def _where(dotted_name: str, root: Path) -> str:
    """The file and the line of the key that hold a dotted name."""
    for path in sorted((root / ANSWERS).glob("*.toml")):
        lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
        for number, line in enumerate(lines, 1):
            if f'"{dotted_name}"' in line:
                return f" in {(ANSWERS / path.name).as_posix()}, line {number}"
    return ""


def _meant(module_name: str, name: str) -> str:
    """What to write instead of a name that is not there, if that can be told."""
    if not name:
        package, _, function = module_name.rpartition(".")
        return f"; write {package}:{function}, with a colon before the function"
    near = get_close_matches(name, dir(sys.modules.get(module_name)), 1)
    return f"; perhaps {module_name}:{near[0]} is meant" if near else ""
