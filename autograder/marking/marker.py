"""Marks the responses of one run: holds the key, draws each question once, runs no response.

The grader uses it directly; a student's notebook talks to it in a process of its own
(`autograder.marking.marker_process`).
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from typing import Any

from autograder.course import Course
from autograder.kinds.drawn import Drawn
from autograder.kinds.registry import kind_of
from autograder.marking import Mark
from autograder.marking.around import around
from autograder.marking.draw import draw


class Marker:
    """The key of a course, ready to mark; the same seed draws the same hidden inputs."""

    def __init__(self, course: Course, seed: int) -> None:
        self.course = course
        self.seed = seed
        self._drawn: dict[str, Drawn] = {}

    def drawn(self, id: str) -> Drawn:
        """What is sent to the student's process for a question, and what to expect of it.

        Raises:
            UsageError: if there is no such question.
            CourseError: if its key is broken.
        """
        if id not in self._drawn:
            question = self.course.question(id)
            drawn = draw(question, self.course.key[id], self.seed, self.course.root)
            self._drawn[id] = replace(drawn, around=around(self.course, question))
        return self._drawn[id]

    def prepare(self, ids: Collection[str] | None = None) -> None:
        """Draw for these questions, or for all, before several threads ask for them."""
        for id in self.course.questions if ids is None else ids:
            self.drawn(id)

    def mark(self, id: str, response: Any, understood: str = "") -> Mark:
        """Mark a response: what a widget kept, or what came back for the question's probe.

        Nothing in it is trusted. ``understood`` is what it looked like before any probe was sent.
        """
        question = self.course.question(id)
        return kind_of(question).mark(
            question, self.course.key[id], self.drawn(id), response, understood
        )
