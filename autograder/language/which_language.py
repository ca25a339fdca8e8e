"""Which language is spoken: the course's, else the one that a person has chosen, else English.

``[tool.autograder] language`` says which language a course speaks. Where it says nothing, a
notebook follows the environment variable ``LANGUAGE``, as gettext does; grading does not, so that
all students read the same whoever grades.
"""

from __future__ import annotations

import os
from functools import lru_cache
from pathlib import Path

_HERE = Path(__file__).parent
_state = {"course": "", "person": ""}


def use(language: str) -> None:
    """Speak the language of a course; empty if it says nothing."""
    _state["course"] = language


def follow_environment() -> None:
    """Where the course says nothing, speak the first language in ``LANGUAGE`` that is known."""
    wanted = os.environ.get("LANGUAGE", "").split(":")
    plain = [name.partition(".")[0].partition("_")[0] for name in wanted]
    _state["person"] = next((name for name in plain if name in languages()), "")


def chosen() -> str:
    """The language that is spoken, such as ``de``."""
    return _state["course"] or _state["person"] or "en"


@lru_cache(maxsize=1)
def languages() -> tuple[str, ...]:
    """The languages that are known: English, and those with a catalog."""
    return ("en", *sorted(path.stem for path in _HERE.glob("*.po")))
