"""One job of the proof: a mutant that must lose credit, or a variant that must earn everything."""

from __future__ import annotations

import os
from contextlib import suppress
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, NamedTuple

from autograder.authoring.proof_of_right_work import RightWork
from autograder.course import Course, load_course
from autograder.course.questions import Question
from autograder.marking.draw import random_numbers
from autograder.mutants.mutant import OutOfTime, Trial
from autograder.questions.registry import kind_of

MUTANT_SEEDS = range(1, 11)


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
        self._right_work = RightWork(self._course)

    def work(self, job: Job) -> Any:
        """For a mutant what it passed, nothing if it lost; for a variant what is wrong with it."""
        question = self._course.question(job.question)
        if job.variant is not None:
            return self._right_work.problem(question, job.variant)
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
