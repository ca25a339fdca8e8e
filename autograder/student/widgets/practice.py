"""A round of practice: the question, the way to the next one, and a picture of what is known."""

from __future__ import annotations

from autograder.reports.markdown import inline
from autograder.student.desk import Desk
from autograder.student.practice.boxes import BOXES, KNOWN
from autograder.student.practice.round import Practice, summary
from autograder.student.widgets.base import CourseWidget, source


class PracticeWidget(CourseWidget):
    """Starts rounds and shows their questions, each in a widget of its own."""

    _esm = source("common.js", "kernel_line.js", "practice.js")
    _css = source("common.css", "practice.css")

    def __init__(self, desk: Desk, practice: Practice) -> None:
        self.practice = practice
        super().__init__(desk)
        practice.on_change = lambda: self.follow("")

    def what_is_fixed(self) -> dict[str, object]:
        return {"label": "Practice", "boxes": BOXES, "known": KNOWN}

    def what_is_kept(self) -> dict[str, object]:
        placed = self.practice.placed()
        titles = {chapter.name: chapter.title for chapter in self.desk.course.chapters}
        return {
            "left": self.practice.seconds_left,
            "running": self.practice.widget is not None,
            "asked": self.practice.asked,
            "right": self.practice.right,
            "summary": summary(placed),
            "rows": [
                {
                    "id": entry.question.id,
                    "title": inline(entry.question.title),
                    "chapter": titles[entry.question.chapter],
                    "box": entry.card.box,
                    "asked": entry.card.asked,
                    "right": entry.card.right,
                }
                for entry in placed
            ],
        }

    def do_start(self, message: dict[str, object]) -> dict[str, object]:
        """Begin a round."""
        return {"child": self.practice.start().model_id}

    def do_next(self, message: dict[str, object]) -> dict[str, object]:
        """Go on; the reply has no child when the time is over."""
        widget = self.practice.next()
        return {"child": widget.model_id if widget is not None else None}

    def do_stop(self, message: dict[str, object]) -> dict[str, object]:
        """End the round."""
        self.practice.stop()
        return {}

    def close(self) -> None:
        self.practice.stop()
        super().close()
