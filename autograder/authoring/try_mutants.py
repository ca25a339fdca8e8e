"""The proof by mutants and by variants: which small changes of what is right marking misses."""

from __future__ import annotations

from collections.abc import Callable

from autograder.authoring.job_processes import share_out
from autograder.authoring.kept_findings import (
    Findings,
    Survivor,
    digest_of,
    keep_findings,
    read_findings,
)
from autograder.authoring.proof_job import Job, trial_of
from autograder.course import Course
from autograder.course.right_work import right_work_of
from autograder.mutants.mutant import Mutant


def try_all(
    course: Course, report: Callable[[str], None] = lambda step: None
) -> dict[str, Findings]:
    """The findings for every question that has something to change, by its id.

    Raises:
        CourseError: if the key or a variant cannot be loaded.
    """
    found: dict[str, Findings] = {}
    waiting: dict[str, str] = {}
    for question in course.questions.values():
        digest = digest_of(course, question)
        kept = read_findings(course, question.id, digest)
        if kept is not None:
            found[question.id] = kept
        else:
            waiting[question.id] = digest
    jobs: list[Job] = []
    mutants: dict[str, list[Mutant]] = {}
    for id in waiting:
        trial = trial_of(course, course.question(id))
        mutants[id] = list(trial.mutants) if trial is not None else []
        jobs += [Job(id, mutant=index) for index in range(len(mutants[id]))]
        jobs += [Job(id, variant=name) for name in right_work_of(course, course.question(id))]
    survivors: dict[str, list[Survivor]] = {id: [] for id in waiting}
    variants: dict[str, dict[str, str]] = {id: {} for id in waiting}
    for done, (job, result) in enumerate(share_out(course.root, jobs), 1):
        report(f"mutants ({done} of {len(jobs)})")
        if job.variant is not None:
            wrong = result if isinstance(result, str) else "it never ends"
            variants[job.question][job.variant] = wrong
        elif result:
            assert job.mutant is not None
            survivor = Survivor(mutants[job.question][job.mutant], tuple(result))
            survivors[job.question].append(survivor)
    for id, digest in waiting.items():
        names = tuple(mutant.name for mutant in mutants[id])
        left = tuple(sorted(survivors[id], key=lambda entry: names.index(entry.mutant.name)))
        found[id] = Findings(len(names), names, left, variants[id])
        keep_findings(course, id, digest, found[id])
    return {id: found[id] for id in course.questions}
