"""Statements in a table, each with two radio buttons."""

from __future__ import annotations

from pathlib import Path

from autograder.errors import UsageError
from autograder.kinds.true_false.question import TrueFalse
from autograder.language import _
from autograder.reports.markdown import inline
from autograder.student.widgets.base import source
from autograder.student.widgets.choice import ChoiceWidget

HERE = Path(__file__).parent


class TrueFalseWidget(ChoiceWidget):
    """A true/false question."""

    _esm = source("common.js", "kernel_line.js", "question.js", HERE / "widget.js")
    _css = source("common.css", HERE / "widget.css")
    question: TrueFalse

    def what_is_fixed(self) -> dict[str, object]:
        statements = [inline(statement) for statement in self.question.statements]
        return {**super().what_is_fixed(), "statements": statements}

    def do_choose(self, message: dict[str, object]) -> dict[str, object]:
        """Keep the choice for one statement; the others stay as they are kept, by whomever."""
        at, said = message["statement"], message["said"]
        count = len(self.question.statements)
        if not (isinstance(at, int) and 0 <= at < count and isinstance(said, bool)):
            refusal = _("{question} has no such statement; run the cell again.")
            raise UsageError(refusal.format(question=self.question.id))

        def chosen(response: object) -> list[bool | None]:
            now = list(response) if isinstance(response, list) else [None] * count
            now[at] = said
            return now

        self.desk.keep(self.question, chosen)
        return {}
