"""The desk of one fresh variant: nothing is kept, nothing counts, and its numbers are its own."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

from autograder.course import Course
from autograder.course.questions import Question
from autograder.exchange.responses import Entry
from autograder.language import N_, _
from autograder.questions.mark import Mark
from autograder.questions.registry import kind_of
from autograder.student.desk import Desk
from autograder.student.marker_client import MarkerClient, VariantMarker, key_marker
from autograder.student.responses import Responses

PRACTICE = N_("Practice: as often as you like, and without points.")
MOST_TRIED = 100  # variants, until one is found that asks in other words


class PracticeDesk(Desk):
    """One variant of one question, asked for practice.

    ``on_mark`` is told of each mark.
    """

    counts = False

    def __init__(
        self,
        desk: Desk,
        id: str,
        variant: int,
        client: MarkerClient,
        on_mark: Callable[[Mark], object] = lambda mark: None,
    ) -> None:
        super().__init__(desk.course.with_variants({**desk.course.variants, id: variant}))
        self.question = self.course.question(id)
        self._entry: Entry = {}
        self._marker = VariantMarker(client, variant)
        self._on_mark = on_mark

    def responses(self, question: Question) -> Responses:
        return _InMemory(self)

    def chapter_responses(self, name: str) -> Responses:
        return _InMemory(self)

    def whose(self, question: Question) -> str:
        return _(PRACTICE)

    def marker(self) -> VariantMarker:
        return self._marker

    def variables(self) -> dict[str, Any]:
        """The numbers of the variant, and no variable of the notebook, which has others."""
        return dict(self.course.numbers(self.question.id) or {})

    def assign(self, question: Question, value: object) -> None:
        """The notebook's variable belongs to the student's own answer."""

    def note(
        self,
        question: Question,
        mark: Mark,
        response: Callable[[Entry], Any],
        understood: str = "",
    ) -> None:
        super().note(question, mark, response, understood)
        self._on_mark(mark)


class _InMemory(Responses):
    """A file of responses that is none."""

    def __init__(self, desk: PracticeDesk) -> None:
        super().__init__(Path(tempfile.gettempdir()), "practice")
        self._desk = desk

    def all(self) -> dict[str, Entry]:
        return {self._desk.question.id: self._desk._entry}

    def update(self, id: str, change: Callable[[Entry], Entry]) -> Entry:
        self._desk._entry = change(dict(self._desk._entry))
        return self._desk._entry

    def refusal(self) -> str:
        return ""


def has_variants(desk: Desk, question: Question) -> bool:
    """Whether a fresh variant of a question can be drawn and marked here.

    One whose words are the same in all variants has none: what it asks is a formula, say, and only
    its feedback has numbers. Nor has one whose key is the same, where nothing is drawn from a bank:
    it asks the same with another example.
    """
    written = desk.course.varied.get(question.id)
    if written is None or written.variables is None or kind_of(question).varies_in_words:
        return False
    if key_marker(desk.course, question.id) is None:
        return False
    others = range(1, min(written.variables.count, MOST_TRIED))

    def differs(what: Callable[[Course], object]) -> bool:
        sheets = what(desk.course.with_variants({question.id: 0}))
        own = (what(desk.course.with_variants({question.id: variant})) for variant in others)
        return any(one != sheets for one in own)

    drawn = kind_of(question).drawn_fields[0]
    return differs(lambda course: course.question(question.id)) and bool(
        drawn or differs(lambda course: course.key[question.id])
    )


def can_be_read(desk: Desk, question: Question) -> bool:
    """Whether functions can be read here for a question that asks to write one."""
    return kind_of(question).can_be_read and key_marker(desk.course, question.id) is not None
