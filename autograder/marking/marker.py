"""Marks the responses of one run: holds the key, draws every probe once, and never runs a response.

The grader uses it directly; a student's notebook talks to it in a process of its own
(`autograder.student.marker_process`).
"""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

from autograder.course import Course
from autograder.kinds.registry import kind_of
from autograder.marking import Mark
from autograder.marking.make_probe import make_probe
from autograder.marking.probe import Probe


class Marker:
    """The key of a course, ready to mark; the same seed draws the same hidden inputs."""

    def __init__(self, course: Course, seed: int) -> None:
        self.course = course
        self.seed = seed
        self._probes: dict[str, Probe] = {}

    def probe(self, id: str) -> Probe:
        """What is sent to the student's process for a question, and what to expect of it.

        Raises:
            UsageError: if there is no such question.
            CourseError: if its key is broken.
        """
        if id not in self._probes:
            question = self.course.question(id)
            self._probes[id] = make_probe(
                question, self.course.key[id], self.seed, self.course.root
            )
        return self._probes[id]

    def prepare(self, ids: Collection[str] | None = None) -> None:
        """Draw the probes of these questions, or of all, before several threads ask for them."""
        for id in self.course.questions if ids is None else ids:
            self.probe(id)

    def mark(self, id: str, response: Any, understood: str = "") -> Mark:
        """Mark a response: what a widget kept, or what came back for the question's probe.

        Nothing in it is trusted. ``understood`` is what it looked like before any probe was sent.
        """
        question = self.course.question(id)
        return kind_of(question).mark(
            question, self.course.key[id], self.probe(id), response, understood
        )
