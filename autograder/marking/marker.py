"""Marks the responses of one run: holds the key, draws each question once, runs no response.

The grader uses it directly; a student's notebook talks to it in a process of its own
(`autograder.marking.marker_process`).
"""

from __future__ import annotations

import threading
from collections.abc import Collection
from dataclasses import replace

import numpy as np

from autograder.course import Course
from autograder.course.questions import Question
from autograder.errors import UsageError
from autograder.language import _
from autograder.marking import Mark
from autograder.marking.draw import draw, seed_of_set, set_of_variant
from autograder.marking.neighbors import around
from autograder.questions.answer import Answer
from autograder.questions.drawn import Drawn
from autograder.questions.functions_to_read import Reading
from autograder.questions.registry import kind_of

OTHER_NUMBERS = "right for other numbers"  # the name of the mistake
MOST_TRIED = 500  # variants that a wrong response is compared with


class Marker:
    """The key of a course, ready to mark; the same seed draws the same hidden inputs.

    ``tells`` is as in `Drawn`: leave it out only where feedback does not go back to students.
    """

    def __init__(self, course: Course, seed: int, tells: bool = True) -> None:
        self.course = course
        self.seed = seed
        self._tells = tells
        self._drawn: dict[str, Drawn] = {}
        self._variants: dict[str, list[tuple[Question, Answer, Drawn]]] = {}
        self._of_all: Marker | None = None  # of whom this is the marker of one student
        self._sets: dict[int, Marker] = {}
        self._practised: dict[tuple[str, int], Marker] = {}
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
        if self._of_all is not None:
            if id not in self.course.variants:
                return self._of_all.drawn(id)
            if kind_of(self.course.question(id)).varies_in_words:
                number = set_of_variant(self.course.variants[id])
                return self._of_all.with_set(number).drawn(id)
        if id not in self._drawn:
            with self._drawing:  # once, whichever of several threads asks first
                if id not in self._drawn:
                    question = self.course.question(id)
                    answer = self.course.key[id]
                    drawn = draw(question, answer, self.seed, self.course.root)
                    near = around(self.course, question)
                    self._drawn[id] = replace(drawn, tells=self._tells, around=near)
        return self._drawn[id]

    def for_student(self, student: str) -> Marker:
        """The marker of a student's own numbers; what does not vary is drawn once for all.

        ``student`` is what they say they are called.
        """
        course = self.course.for_student(student)
        if course is self.course:
            return self
        own = Marker(course, self.seed, self._tells)
        own._variants, own._of_all = self._variants, self
        return own

    def of_variant(self, id: str, variant: int) -> Marker:
        """The marker of one variant of a question, for practice.

        Raises:
            UsageError: if there is no such variant.
        """
        written = self.course.varied.get(id)
        count = written.variables.count if written and written.variables else 1
        if not (isinstance(variant, int) and 0 <= variant < count):
            raise UsageError(f"{id} has no variant {variant!r}.")
        if variant == self.course.variants.get(id, 0):
            return self
        if (id, variant) not in self._practised:
            course = self.course.with_variants({**self.course.variants, id: variant})
            self._practised[id, variant] = Marker(course, self.seed, self._tells)
        return self._practised[id, variant]

    def reading(self, id: str, seed: int) -> Reading:
        """Functions to read, drawn by a seed, for a question that asks to write one.

        Raises:
            UsageError: if there is nothing to read for it.
        """
        question, answer = self.course.question(id), self.course.key[id]
        names = [other.name for other in self.course.questions.values() if other.name]
        rng = np.random.default_rng([self.seed, seed])
        found = kind_of(question).reading(
            question, answer, self.drawn(id), rng, self.course.root, names
        )
        if found is None:
            raise UsageError(f"There are no functions to read for {id}.")
        return found

    def prepare(self, ids: Collection[str] | None = None) -> None:
        """Draw for these questions, or for all, before several threads ask for them."""
        for id in self.course.questions if ids is None else ids:
            self.drawn(id)

    def mark(self, id: str, response: object, understood: str = "") -> Mark:
        """Mark a response: what a widget kept, or what came back for the question's probe.

        Nothing in it is trusted. ``understood`` is what it looked like before any probe was sent.
        """
        question = self.course.question(id)
        mark = kind_of(question).mark(
            question, self.course.key[id], self.drawn(id), response, understood
        )
        nameless = mark.status == "wrong" and mark.alternative is None
        if nameless and self._has_others(id):
            return self._of_other_numbers(mark, response, understood) or mark
        return mark

    def _has_others(self, id: str) -> bool:
        """Whether a response can be right for the numbers of somebody else, and not by chance.

        Any choice of statements and any order of cards fits some deal of them.
        """
        if not self.course.personal or id not in self.course.varied:
            return False
        return bool(kind_of(self.course.question(id)).formulas)

    def _all_variants(self, id: str) -> list[tuple[Question, Answer, Drawn]]:
        """The variants of a question, made once for all students."""
        if id not in self._variants:
            variables = self.course.varied[id].variables
            assert variables is not None
            made = []
            for variant in range(min(variables.count, MOST_TRIED)):
                course = self.course.with_variants({**self.course.variants, id: variant})
                question, answer = course.question(id), course.key[id]
                made.append((question, answer, draw(question, answer, self.seed, course.root)))
            self._variants[id] = made
        return self._variants[id]

    def _of_other_numbers(self, mark: Mark, response: object, understood: str) -> Mark | None:
        """The mark with a name, if the response is right for the numbers of somebody else."""
        variables = self.course.varied[mark.question].variables
        assert variables is not None
        for variant, (question, answer, drawn) in enumerate(self._all_variants(mark.question)):
            other = kind_of(question).mark(question, answer, drawn, response, understood)
            if other.status == "right":
                numbers = variables.numbers(variant)
                told = ", ".join(f"{name} = {value:g}" for name, value in numbers.items())
                feedback = _(
                    "That is right for other numbers ({numbers}); yours stand in the question."
                ).format(numbers=told)
                return replace(mark, alternative=OTHER_NUMBERS, feedback=feedback)
        return None
