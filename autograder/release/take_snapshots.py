"""Takes the snapshots of a course: examples with their right outcomes, and nothing else of the key.

What a snapshot of a question holds is the business of its kind.
"""

from __future__ import annotations

from autograder.course import Chapter, Course
from autograder.exchange.messages import Message
from autograder.marking.draw import draw
from autograder.questions.json_arrays import pack
from autograder.questions.registry import kind_of

# The grader's seeds have 32 bits, so these inputs never grade anybody.
SEED = 1 << 40


def chapter_snapshots(course: Course, chapter: Chapter) -> tuple[Message, list[str]]:
    """The snapshots of a chapter's questions by id, as JSON data, and what they cannot tell."""
    snapshots: dict[str, object] = {}
    blind: list[str] = []
    for question in chapter.questions:
        answer = course.key[question.id]
        drawn, again = (draw(question, answer, seed, course.root) for seed in (SEED, SEED + 1))
        taken = kind_of(question).take_snapshot(question, answer, drawn, again)
        if taken is not None:
            snapshot, missed = taken
            snapshots[question.id] = pack(snapshot)
            blind += [f"{question.id}: {name}" for name in missed]
    return snapshots, blind
