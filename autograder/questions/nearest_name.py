"""Which known name is meant by one that is unknown."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

_ALIKE = 0.75  # how alike two names must be for one to be meant by the other: not points and hints


def meant(name: str, known: Iterable[str]) -> str:
    """What to do about a name that is not known: which of those it looks like, if any."""
    near = nearest(name, known)
    return f"perhaps {near!r} is meant" if near else "remove or correct it"


def nearest(name: str, known: Iterable[str]) -> str:
    """The known name that another one is a slip of; empty if it looks like none."""
    return next(iter(get_close_matches(name, list(known), 1, _ALIKE)), "")
