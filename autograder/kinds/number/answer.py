"""What is right: known values, right and wrong."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta, field

from autograder.questions.answer import Alternative, Answer


class NumberAlternative(Alternative, frozen=True, kw_only=True):
    """A value, and how far a response may be from it (None: as the question says)."""

    value: float
    tolerance: Annotated[float, Meta(ge=0)] | None = None


class NumberAnswer(Answer, frozen=True, kw_only=True):
    """The key to a number question."""

    alternatives: tuple[NumberAlternative, ...] = field(default=(), name="alternative")
