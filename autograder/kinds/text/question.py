"""What is asked: a few words, a paragraph, a proof."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from autograder.kinds.question import Question
from autograder.kinds.toml_table import Table

LONGEST = 4000  # characters, unless the question says otherwise
MOST = 9_000  # each may become two in a file, and what is read of a response is bounded


@dataclass(frozen=True)
class Text(Question):
    """Something to describe; Markdown with formulas may be written, of ``longest`` characters."""

    kind = "text"
    longest: int = LONGEST


def read_question(table: Table, common: dict[str, Any]) -> Text:
    """The question in an author's table."""
    longest = table.take("longest", int, LONGEST)
    if not 0 < longest <= MOST:
        raise table.error(f"longest is {longest}; give a number of characters up to {MOST}")
    return Text(**common, points=table.points(), longest=longest)
