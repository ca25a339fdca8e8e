"""Marks the responses of one run: holds the key, draws each question once, runs no response.

The grader uses it directly; a student's notebook talks to it in a process of its own
(`autograder.marking.marker_process`).
"""

from __future__ import annotations

import threading
from collections.abc import Collection
from dataclasses import replace
from typing import Any

from autograder.course import Course
from autograder.kinds.drawn import Drawn
from autograder.kinds.registry import kind_of
from autograder.marking import Mark
from autograder.marking.draw import draw, seed_of_set


class Marker:
    """The key of a course, ready to mark; the same seed draws the same hidden inputs.

    ``tells`` is as in `Drawn`: leave it out only where feedback does not go back to students.
    """

    def __init__(self, course: Course, seed: int, tells: bool = True) -> None:
        self.course = course
        self.seed = seed
        self._tells = tells
        self._drawn: dict[str, Drawn] = {}
        self._sets: dict[int, Marker] = {}
        self._lock, self._drawing = threading.Lock(), threading.Lock()

    def with_set(self, number: int) -> Marker:
        """A marker for another set of hidden inputs, as `set_number` counts them."""
        if number == 0:
            return self
        with self._lock:
            if number not in self._sets:
                self._sets[number] = Marker(
                    self.course, seed_of_set(self.seed, number), self._tells
                )
            return self._sets[number]

    def drawn(self, id: str) -> Drawn:
        """What is sent to the student's process for a question, and what to expect of it.

        Raises:
            UsageError: if there is no such question.
            CourseError: if its key is broken.
        """
        if id not in self._drawn:
            with self._drawing:  # once, whichever of several threads asks first
                if id not in self._drawn:
                    question = self.course.question(id)
                    answer = self.course.key[id]
                    drawn = draw(question, answer, self.seed, self.course.root)
                    self._drawn[id] = replace(drawn, tells=self._tells)
        return self._drawn[id]

    def for_student(self, student: str) -> Marker:
        """The marker of a student's own numbers; what does not vary is drawn once for all.

        ``student`` is what they say they are called.
        """
        course = self.course.for_student(student)
        if course is self.course:
            return self
        own = Marker(course, self.seed)
        own._drawn = {id: drawn for id, drawn in self._drawn.items() if id not in course.variants}
        return own

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
