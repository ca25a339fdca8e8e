"""Whether marks were made with the questions and the key of now."""

from __future__ import annotations

from collections.abc import Sequence

from autograder.course import Course
from autograder.errors import AutograderError
from autograder.gradebook.record import Record


class StaleMarks(AutograderError):
    """Marks in the gradebook were made before the course changed."""


def require_current(course: Course, records: Sequence[Record]) -> str:
    """Refuse to hand out points that the course no longer gives, and say what else has changed.

    That is a sentence, as of the words of a question, or nothing.

    Raises:
        StaleMarks: if points or questions have changed since the work was marked.
    """
    changed = sorted(
        {
            mark.question
            for record in records
            for mark in record.graded.marks
            if mark.question in course.questions
            and abs(mark.max_points - course.questions[mark.question].points) > 1e-9
        }
    )
    if changed:
        raise StaleMarks(
            f"The points of {', '.join(changed)} have changed since the class was marked; run "
            "`autograder regrade`, then export again."
        )
    asked = set(course.questions)
    unmarked = [r for r in records if not r.questions >= asked]
    if unmarked:
        missing = sorted(asked - unmarked[0].questions)
        raise StaleMarks(
            f"{unmarked[0].name} has no mark for {', '.join(missing[:5])}: the course has changed "
            "since, or only some questions were marked; run `autograder regrade`, then export "
            "again."
        )
    old = sum(record.course_version not in ("", course.version) for record in records)
    if not old:
        return ""
    return (
        f"{old} of {len(records)} submissions were marked before the questions or the key last "
        "changed; `autograder regrade --dry-run` shows whether that matters."
    )
