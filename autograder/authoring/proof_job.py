"""One job of the proof: a mutant that must lose credit, or a variant that must earn everything."""

from __future__ import annotations

import os
from contextlib import suppress
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, NamedTuple

from msgspec import structs

from autograder.course import Course, load_course
from autograder.course.questions import Question
from autograder.course.right_work import right_work_of
from autograder.marking.draw import draw, random_numbers
from autograder.mutants.mutant import OutOfTime, Trial
from autograder.mutants.time_limit import time_limit
from autograder.questions.answer import Answer
from autograder.questions.drawn import Drawn
from autograder.questions.registry import kind_of
from autograder.sandbox.inside.evaluate import evaluate

MUTANT_SEEDS = range(1, 11)
VARIANT_SEEDS = range(1, 26)
_VARIANT_SECONDS = 5.0  # of a processor, for a variant and the hidden inputs of one seed


class Job(NamedTuple):
    """A mutant by its number, or a variant by its name, of one question."""

    question: str
    mutant: int | None = None
    variant: str | None = None


def trial_of(course: Course, question: Question) -> Trial | None:
    """The mutants of what is right for a question, None if there is nothing to change."""
    references = [
        name
        for id, answer in course.key.items()
        for name in kind_of(course.question(id)).solutions(answer)[:1]
    ]
    return kind_of(question).trial(
        question,
        course.key[question.id],
        references,
        course.root,
        lambda seed: random_numbers(question, seed),
    )


class Bench:
    """What one process tries mutants and variants with."""

    def __init__(self, root: Path) -> None:
        self._course = load_course(root)
        self._trials: dict[str, Trial | None] = {}
        self._drawn: dict[tuple[str, int], Drawn] = {}

    def work(self, job: Job) -> Any:
        """For a mutant what it passed, nothing if it lost; for a variant what is wrong with it."""
        question = self._course.question(job.question)
        if job.variant is not None:
            return self._variant(question, job.variant)
        assert job.mutant is not None
        return self._mutant(question, job.mutant)

    def _mutant(self, question: Question, index: int) -> list[str]:
        if question.id not in self._trials:
            self._trials[question.id] = trial_of(self._course, question)
        trial = self._trials[question.id]
        assert trial is not None
        for seed in MUTANT_SEEDS:
            try:
                if trial.passes(index, seed):
                    return list(trial.cases(seed))
            except (OutOfTime, MemoryError):
                return []  # a student's function that does this earns nothing
        return []

    def _variant(self, question: Question, name: str) -> str:
        kind, answer = kind_of(question), self._answer(question)
        written = right_work_of(self._course, question)[name]
        try:
            response = kind.variant(question, written)
        except Exception as error:  # the course's own code may do anything
            return f"it cannot be made: {type(error).__name__}: {error}"
        for seed in VARIANT_SEEDS:
            drawn = self._draw(question, answer, seed)
            try:
                with time_limit(_VARIANT_SECONDS):
                    found = evaluate(response, drawn.probe)
            except OutOfTime:
                return f"with seed {seed} it takes more than {_VARIANT_SECONDS:g} s"
            mark = kind.mark(question, answer, drawn, found)
            if mark.credit != 1:
                return f"with seed {seed} it gets {mark.credit:g} credit: {mark.feedback}"
        return ""

    def _answer(self, question: Question) -> Answer:
        """The key; without the mistakes that take long and change nothing for what is right."""
        answer = self._course.key[question.id]
        if not kind_of(question).solutions(answer):
            return answer
        right = tuple(entry for entry in answer.alternatives if not entry.is_mistake)
        return structs.replace(answer, alternatives=right)

    def _draw(self, question: Question, answer: Answer, seed: int) -> Drawn:
        if (question.id, seed) not in self._drawn:
            self._drawn[question.id, seed] = draw(question, answer, seed, self._course.root)
        return self._drawn[question.id, seed]


def serve(root: Path, pipe: Connection) -> None:
    """Do the jobs that come through a pipe, one after the other."""
    import resource
    import sys

    with suppress(OSError), open(os.devnull, "w", encoding="utf-8") as nowhere:
        sys.stdout = nowhere  # a mutant may print
        bench = Bench(root)
        size = int(Path("/proc/self/statm").read_bytes().split()[0]) * resource.getpagesize()
        limit = size + 2 * 2**30
        resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
        while True:
            try:
                job = pipe.recv()
            except EOFError:
                return
            pipe.send(bench.work(job))
