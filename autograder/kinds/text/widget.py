"""A field for a paragraph of Markdown, shown below as it will be read."""

from __future__ import annotations

from pathlib import Path

from autograder.kinds.text.question import Text
from autograder.questions.registry import kind_of
from autograder.reports.markdown import markdown
from autograder.student.widgets.base import source
from autograder.student.widgets.choice import ChoiceWidget

HERE = Path(__file__).parent


class TextWidget(ChoiceWidget):
    """A text question."""

    _esm = source("common.js", "kernel_line.js", "question.js", HERE / "widget.js")
    _css = source("common.css", HERE / "widget.css")
    question: Text

    def what_is_fixed(self) -> dict[str, object]:
        return {**super().what_is_fixed(), "longest": self.question.longest, "marks": False}

    def what_is_kept(self) -> dict[str, object]:
        kept = super().what_is_kept()
        return {**kept, "shown": markdown(kept["response"]) if kept["response"] else ""}

    def do_write(self, message: dict[str, object]) -> dict[str, object]:
        """Keep what stands in the field."""
        said = kind_of(self.question).read_response(self.question, message["text"])
        self.desk.keep(self.question, lambda before: said)
        return {}
