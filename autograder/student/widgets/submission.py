"""What is handed in: where the file is, what it holds and what is unanswered."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime

from autograder.student.desk import Desk
from autograder.student.responses import answered
from autograder.student.views import SubmissionView
from autograder.student.widgets.base import CourseWidget, source


class SubmissionWidget(CourseWidget):
    """The panel that ``submit()`` shows; it packs again on a click."""

    _esm = source("common.js", "kernel_line.js", "submission.js")
    _css = source("common.css", "submission.css")

    def __init__(
        self, desk: Desk, packed: SubmissionView, pack: Callable[[], SubmissionView]
    ) -> None:
        self._pack = pack
        self._take(packed)
        super().__init__(desk)

    def what_is_fixed(self) -> dict[str, object]:
        return {"label": "Submission"}

    def what_is_kept(self) -> dict[str, object]:
        packed = self._packed
        kept = self.desk.entries()
        return {
            "path": str(packed.packed.path),
            "file": packed.packed.path.name,
            "packed_at": self._packed_at,
            "names": list(packed.packed.names),
            "warning": packed.warning,
            "advice": packed.advice,
            "nameless": packed.nameless,
            "taken": packed.taken,
            "chapters": [
                {
                    "title": chapter.title,
                    "questions": [
                        {
                            "label": f"{question.id} · {question.title}",
                            "answered": answered(kept[chapter.name].get(question.id)),
                        }
                        for question in chapter.questions
                    ],
                }
                for chapter in self.desk.course.chapters
            ],
            "stale": self._stale,
        }

    def follow(self, id: str) -> None:
        """An answer changed after the file was packed."""
        self._stale = True
        super().follow(id)

    def do_pack(self, message: dict[str, object]) -> dict[str, object]:
        """Pack again."""
        self._take(self._pack())
        return {}

    def _take(self, packed: SubmissionView) -> None:
        self._packed = packed
        self._packed_at = datetime.now().strftime("%H:%M:%S")
        self._stale = False
