"""Functions to read: which is right, and what does one that is wrong return?"""

from __future__ import annotations

from collections.abc import Callable

from autograder.course.questions import Question
from autograder.errors import UsageError
from autograder.language import _
from autograder.reports.markdown import inline
from autograder.student.desk import Desk
from autograder.student.marker_client import MarkerClient
from autograder.student.practice.desk import PRACTICE
from autograder.student.widgets.base import CourseWidget, source


class ReadingWidget(CourseWidget):
    """Three functions for a question that asks to write one; ``seed`` says which."""

    _esm = source("common.js", "kernel_line.js", "reading.js")
    _css = source("common.css", "value.css", "reading.css")

    def __init__(
        self,
        desk: Desk,
        question: Question,
        client: MarkerClient,
        seed: int,
        on_result: Callable[[bool], object],
    ) -> None:
        self.question, self._client, self._seed = question, client, seed
        self._on_result = on_result
        self._shown = client.reading(question.id, seed)
        self._verdict: dict[str, object] = {}
        super().__init__(desk)

    def what_is_fixed(self) -> dict[str, object]:
        return {
            **self._shown,
            "label": _("{question} · Read: {title}").format(
                question=self.question.id, title=self.question.title
            ),
            "function": self.question.name,
            "foot": _(PRACTICE),
        }

    def what_is_kept(self) -> dict[str, object]:
        return {"verdict": self._verdict}

    def do_check(self, message: dict[str, object]) -> dict[str, object]:
        """Mark both answers at once; they are given once, since the verdict tells the truth."""
        chosen, returned = message["chosen"], message["returned"]
        if not (isinstance(chosen, int) and isinstance(returned, int)):
            raise UsageError(_("Answer both parts."))
        if not self._verdict:
            verdict = self._client.mark_reading(self.question.id, self._seed, chosen, returned)
            self._verdict = {**verdict, "said": inline(str(verdict["said"]))}
            self._on_result(bool(verdict["right"]))
        return {}
