"""A bar for each chapter that grows as questions are answered."""

from __future__ import annotations

from autograder.student.desk import Desk
from autograder.student.points_in_words import number
from autograder.student.responses import answered, only_recorded, points
from autograder.student.widgets.base import CourseWidget, source


class ProgressWidget(CourseWidget):
    """Answered questions and points, chapter by chapter."""

    _esm = source("common.js", "kernel_line.js", "progress.js")
    _css = source("common.css", "progress.css")

    def __init__(self, desk: Desk) -> None:
        super().__init__(desk)

    def what_is_fixed(self) -> dict[str, object]:
        return {"label": "Progress"}

    def what_is_kept(self) -> dict[str, object]:
        kept = self.desk.entries()
        chapters = []
        for chapter in self.desk.course.chapters:
            entries = kept[chapter.name]
            chapters.append(
                {
                    "title": chapter.title,
                    "answered": sum(answered(entries.get(q.id)) for q in chapter.questions),
                    "questions": len(chapter.questions),
                    "open": [q.id for q in chapter.questions if not answered(entries.get(q.id))],
                    "later": [q.id for q in chapter.questions if only_recorded(entries.get(q.id))],
                    # Points that leave out what is only recorded would say little.
                    "marks": all(map(self.desk.can_mark, chapter.questions)),
                    "points": number(sum(points(entries.get(q.id)) for q in chapter.questions)),
                    "most": number(sum(q.points for q in chapter.questions)),
                }
            )
        return {"chapters": chapters}
