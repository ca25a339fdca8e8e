"""A round of practice: ten minutes of questions from all chapters, by Leitner's boxes."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from autograder.course.questions import Question
from autograder.errors import UsageError
from autograder.exchange.responses import Entry
from autograder.language import _, n_
from autograder.questions.registry import kind_of
from autograder.student.desk import Desk
from autograder.student.marker_client import key_marker
from autograder.student.practice.another import another_one
from autograder.student.practice.boxes import BOXES, KNOWN, Boxes, Card, draw
from autograder.student.practice.desk import can_be_read, has_variants
from autograder.student.responses import attempts, responses_folder
from autograder.student.widgets.base import CourseWidget

SECONDS = 600.0


@dataclass(frozen=True)
class Placed:
    """A question with its card."""

    question: Question
    card: Card


class Practice:
    """What a student can practise, and the round that runs."""

    def __init__(
        self,
        desk: Desk,
        rng: np.random.Generator | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._desk = desk
        self._rng = rng if rng is not None else np.random.default_rng()
        self._clock = clock
        self._boxes = Boxes(responses_folder(desk.course.root))
        self._unreadable: set[str] = set()
        self._until = 0.0
        self.asked = 0
        self.right = 0
        self.last: str | None = None
        self.widget: CourseWidget | None = None
        self.on_change: Callable[[], object] = lambda: None  # told when a card has moved

    def placed(self) -> list[Placed]:
        """What can be practised now, with its boxes, in the order of the course."""
        entries = {id: e for found in self._desk.entries().values() for id, e in found.items()}
        asked = [q for q in self._desk.course.questions.values() if self._is_open(q, entries)]
        cards = self._boxes.cards([question.id for question in asked], entries)
        return [Placed(question, cards[question.id]) for question in asked]

    def _is_open(self, question: Question, entries: dict[str, Entry]) -> bool:
        """Whether practice may ask it: what has no variants would tell an answer not yet given."""
        if question.id in self._unreadable or kind_of(question).by_hand:
            return False
        if has_variants(self._desk, question):
            return True
        if question.name is not None and not kind_of(question).has_field:
            known = can_be_read(self._desk, question)
        else:
            known = key_marker(self._desk.course, question.id) is not None
        return known and attempts(entries.get(question.id, {})) > 0

    @property
    def seconds_left(self) -> float:
        """Until the round ends; 0 where none runs."""
        return max(0.0, self._until - self._clock())

    def start(self) -> CourseWidget:
        """Begin a round; returns the first question.

        Raises:
            UsageError: if there is nothing to practise.
        """
        self._until = self._clock() + SECONDS
        self.asked = self.right = 0
        widget = self.next()
        assert widget is not None
        return widget

    def next(self) -> CourseWidget | None:
        """The next question; None when the time is over.

        Raises:
            UsageError: if there is nothing to practise.
        """
        self.end_question()
        if self.seconds_left <= 0:
            return None
        while cards := {placed.question.id: placed.card for placed in self.placed()}:
            id = draw(cards, self._rng, self.last)
            question = self._desk.course.question(id)
            try:
                self.widget = another_one(self._desk, question, self._noting(id, cards[id]))
            except UsageError:
                self._unreadable.add(id)  # its functions are too long to be read
                continue
            self.last = id
            return self.widget
        raise UsageError(
            _(
                "There is nothing to practise here. Where the answers are not at hand, only their "
                "instructor can mark them."
            )
        )

    def end_question(self) -> None:
        """Take the question away that is asked now."""
        if self.widget is not None:
            self.widget.close()
            self.widget = None

    def stop(self) -> None:
        """End the round before its time."""
        self.end_question()
        self._until = 0.0

    def _noting(self, id: str, card: Card) -> Callable[[bool], None]:
        """What moves the card by the first response; what is tried again shows no memory."""
        waiting = [card]

        def note(right: bool) -> None:
            if waiting:
                self._boxes.note(id, waiting.pop(), right)
                self.asked += 1
                self.right += right
                self.on_change()

        return note


def summary(placed: list[Placed]) -> str:
    """How much is known, in words."""
    if not placed:
        return _("There is nothing to practise here, since the answers are not at hand.")
    known = sum(entry.card.box >= KNOWN for entry in placed)
    return n_(
        "You know {known} of {count} question, those in boxes {first} and {last}.",
        "You know {known} of {count} questions, those in boxes {first} and {last}.",
        len(placed),
    ).format(known=known, count=len(placed), first=KNOWN, last=BOXES)
