"""What the docstring of a reference promises to raise, and which cases ask for it."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable

from autograder.kinds.function.marking import Expected

# "Raises ValueError if ...", or a line "ValueError: if ..." under a heading "Raises".
_SENTENCE = re.compile(r"\b[Rr]aises\s+(?:an?\s+)?(\w*(?:Error|Exception|Warning))\b([^.]*)")
_SECTION = re.compile(r"^Raises:?\s*(?:-+\s*)?$(.*?)(?=^\S[^\n]*:?$|\Z)", re.M | re.S)
_ENTRY = re.compile(r"^\s+(\w*(?:Error|Exception|Warning))\b:?([^\n]*(?:\n\s{6,}[^\n]*)*)", re.M)


def promises(reference: Callable[..., object], expected: Expected) -> list[tuple[str, list[str]]]:
    """Each promise in words, with the names of the cases in which the reference keeps it."""
    text = inspect.getdoc(reference) or ""
    found = [match.groups() for match in _SENTENCE.finditer(text)]
    for section in _SECTION.finditer(text):
        found += [match.groups() for match in _ENTRY.finditer(section[1])]
    raised: dict[str, dict[str, None]] = {}
    for case, outcome in zip(expected.cases, expected.outcomes, strict=True):
        if "raised" in outcome:
            raised.setdefault(str(outcome["raised"]), {})[case["name"]] = None
    return [
        (" ".join(f"{error}{when}".split()), list(raised.get(error, ()))) for error, when in found
    ]
