"""What is asked: a few words, a paragraph, a proof."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta

from autograder.questions.question import PointedQuestion

LONGEST = 4000  # characters, unless the question says otherwise
MOST = 9_000  # each may become two in a file, and what is read of a response is bounded


class Text(PointedQuestion, frozen=True, kw_only=True, tag="text"):
    """Something to describe; Markdown with formulas may be written, of ``longest`` characters."""

    kind = "text"
    longest: Annotated[int, Meta(ge=1, le=MOST, description="characters")] = LONGEST
