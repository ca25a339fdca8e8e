"""Snapshots: how a student bundle checks code without any key, as the kind of question says.

A snapshot holds inputs that students may see and what the right response gives for them, as plain
numbers in ``notebooks/snapshots/CHAPTER.json``. `autograder.release` takes them.
"""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

from autograder.course import Course
from autograder.course.questions import Question
from autograder.errors import CourseError
from autograder.exchange.messages import Message
from autograder.exchange.why_unusable import REASONS, UNREAD
from autograder.language import _
from autograder.questions.json_arrays import unpack
from autograder.questions.mark import Mark, not_attempted, stopped
from autograder.questions.registry import kind_of
from autograder.questions.snapshot import wrong

SNAPSHOTS = Path("notebooks/snapshots")


def recorded(question: Question, response: Message) -> Mark:
    """The mark of a response that is marked elsewhere, with what the question alone says of it."""
    mark = stopped(question, "recorded")
    said = kind_of(question).remark(question, response)
    return replace(mark, feedback=f"{mark.feedback} {said}") if said else mark


class SnapshotMarker:
    """Marks what the snapshots tell; everything else is recorded."""

    def __init__(self, course: Course) -> None:
        self._course = course
        self._snapshots: dict[str, Message] = {}
        for path in sorted((course.root / SNAPSHOTS).glob("*.json")):
            try:
                self._snapshots |= unpack(json.loads(path.read_text(encoding="utf-8")))
            except (OSError, ValueError, TypeError, KeyError):
                raise CourseError(
                    f"{path} is damaged; take it from the course's download again."
                ) from None

    def can_mark(self, id: str) -> bool:
        """Whether a response to a question can be marked, or only recorded."""
        snapshot = self._snapshots.get(id)
        return snapshot is not None and bool(snapshot["checked"])

    def probe(self, id: str) -> Message:
        """What the kernel has to evaluate for a question."""
        question = self._course.question(id)
        probe = kind_of(question).snapshot_probe(question, self._snapshots.get(id))
        return {**probe, "tell": True}  # students may see all of it

    def mark(self, id: str, response: object, understood: str = "") -> Mark:
        """Mark what came back for the probe."""
        question = self._course.question(id)
        snapshot = self._snapshots.get(id)
        if not isinstance(response, dict):
            return stopped(question, "recorded")
        state, reason = response.get("state"), str(response.get("reason", ""))
        if state == "not attempted":
            return not_attempted(question)
        if snapshot is None or not snapshot["checked"]:
            return recorded(question, response)
        if state == "raised":
            sentence = _("Evaluating {name} raises {error}.")
            sentence = sentence.format(name=question.name, error=response.get("error"))
            return wrong(question, sentence)
        if state != "given":
            why = _(REASONS.get(reason, UNREAD))
            sentence = _("{name} cannot be checked: {why}.").format(name=question.name, why=why)
            return wrong(question, sentence)
        return kind_of(question).mark_snapshot(question, snapshot, response)
