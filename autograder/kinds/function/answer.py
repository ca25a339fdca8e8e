"""What is right: a reference, and whole functions that are wrong in a known way."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta, field

from autograder.questions.answer import Answer, PublicAlternative

Dotted = Annotated[
    str, Meta(pattern=r"\S", description="a function of the course, as package.module:function")
]


class FunctionAlternative(PublicAlternative, frozen=True, kw_only=True):
    """A whole wrong function, by its dotted name ``package.module:function``."""

    function: Dotted


class FunctionAnswer(Answer, frozen=True, kw_only=True):
    """The key to a function question; reference, cases, compare and picture are dotted names."""

    reference: Dotted
    cases: Dotted
    compare: Dotted | None = None
    picture: Dotted | None = None
    alternatives: tuple[FunctionAlternative, ...] = field(default=(), name="alternative")
