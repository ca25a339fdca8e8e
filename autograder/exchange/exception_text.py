"""An exception of a student's own code in words, where nothing hidden had been sent."""

from __future__ import annotations

from autograder.exchange.messages import Told
from autograder.language import _


def in_words(told: Told | None) -> str:
    """``ValueError: no points, at line 3: total = 1 / len(points)``."""
    if not told:
        return ""
    said = f"{told['kind']}: {told['message']}" if told["message"] else str(told["kind"])
    if told["module"]:
        said = missing_module(told)
    if told["line"]:
        at = _("{error}, at line {line} of the cell")
        said = at.format(error=said, line=told["line"])
        said += f": {told['source']}" if told["source"] else ""
    return said


def missing_module(told: Told) -> str:
    """That a module is not there."""
    sentence = _("{module} is not installed where this is marked")
    return sentence.format(module=told["module"])
