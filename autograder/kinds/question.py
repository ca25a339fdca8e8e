"""What every question has, whatever its kind. Nothing here knows an answer."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar


@dataclass(frozen=True)
class Question:
    """One thing asked.

    ``id`` is stable (``Q3.2.1``), ``prompt`` and ``hints`` are Markdown, ``points`` is what a
    right response earns; 0 if it is there for practice only. ``kind`` is the name of the kind's
    folder.
    """

    kind: ClassVar[str]

    id: str
    chapter: str
    title: str
    prompt: str
    hints: tuple[str, ...]
    points: float

    @property
    def name(self) -> str | None:
        """The variable or function that holds the response, or None if it is given to ``ask``."""
        return None
