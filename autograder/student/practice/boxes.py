"""Leitner's boxes: what was right moves one box up, what was wrong goes back to the first.

A question in one box is drawn half as often as one in the box below, so that practice returns to
what is not known yet. The boxes are kept beside the responses, in ``practice.json``.

Source: S. Leitner, *So lernt man lernen*, Freiburg 1972.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from autograder.exchange.responses import Entry
from autograder.student.responses import Responses

FILE = "practice"
BOXES = 5
KNOWN = 4  # from this box on, what is in it counts as known


@dataclass(frozen=True)
class Card:
    """One question in the boxes: where it is, how often it was asked, and how often right."""

    box: int
    asked: int = 0
    right: int = 0

    def after(self, right: bool) -> Card:
        """The card after one more response."""
        box = min(self.box + 1, BOXES) if right else 1
        return replace(self, box=box, asked=self.asked + 1, right=self.right + right)


def first_card(entry: Entry | None) -> Card:
    """Where a question begins: by what became of it in its chapter.

    Right at the first attempt is the third box, not tried the second, anything else the first.
    """
    status = (entry or {}).get("status", "not attempted")
    if status == "right" and (entry or {}).get("attempts") == 1:
        return Card(3)
    return Card(2 if status == "not attempted" else 1)


def draw(cards: Mapping[str, Card], rng: np.random.Generator, last: str | None = None) -> str:
    """The question to ask next, by its id: not the ``last`` one, unless there is no other."""
    names = [name for name in cards if name != last] or list(cards)
    weights = np.array([2.0 ** (BOXES - cards[name].box) for name in names])
    return names[int(rng.choice(len(names), p=weights / weights.sum()))]


class Boxes:
    """The boxes of one student, kept between days."""

    def __init__(self, folder: Path) -> None:
        self._file = Responses(folder, FILE)

    def cards(self, ids: Sequence[str], entries: Mapping[str, Entry]) -> dict[str, Card]:
        """The card of each question; ``entries`` are the responses to the chapters' questions."""
        kept = self._file.all()
        return {id: _card(kept.get(id)) or first_card(entries.get(id)) for id in ids}

    def note(self, id: str, before: Card, right: bool) -> Card:
        """Keep what a response did to a card, which another notebook may have moved meanwhile.

        Raises:
            ResponsesError: if it cannot be saved.
        """
        made = before

        def changed(entry: Entry) -> Entry:
            nonlocal made
            made = (_card(entry) or before).after(right)
            return {"box": made.box, "asked": made.asked, "right": made.right}

        self._file.update(id, changed)
        return made


def _card(entry: Entry | None) -> Card | None:
    """What a file says, if it makes sense: it is the student's, and may say anything."""
    values = [(entry or {}).get(name) for name in ("box", "asked", "right")]
    if not all(type(value) is int for value in values):
        return None
    box, asked, right = (int(str(value)) for value in values)
    return Card(box, asked, right) if 1 <= box <= BOXES and 0 <= right <= asked else None
