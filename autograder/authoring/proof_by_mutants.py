"""What the mutants and the variants say about a course, in sentences."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator

from autograder.authoring.kept_findings import Findings, Survivor
from autograder.authoring.line_in_key import with_line
from autograder.authoring.try_mutants import try_all
from autograder.course import Course
from autograder.course.questions import Question
from autograder.course.right_work import (
    FOLDER,
    has_right_work,
    right_work_of,
    unexpected_right_work,
)
from autograder.marking.marker import Marker
from autograder.questions.registry import kind_of


def prove_by_mutants(
    course: Course, report: Callable[[str], None] = lambda step: None
) -> list[str]:
    """Mutants that keep their credit, right work that loses some, declarations that do not fit.

    Raises:
        CourseError: if the key or a variant cannot be loaded.
    """
    report("mutants")
    problems = unexpected_right_work(course)
    for id, findings in try_all(course, report).items():
        question = course.question(id)
        problems += [f"{id}: {problem}" for problem in _mutants(course, question, findings)]
        problems += [f"{id}: {problem}" for problem in _variants(course, question, findings)]
    return problems


def untested_promises(course: Course, marker: Marker) -> Iterator[str]:
    """Promises to raise that no case asks for."""
    for id, promise, cases in _promises(course, marker):
        if not cases:
            yield f"{id}: no case tests the promise “{promise}”; add one, or do not promise it."


def kept_promises(course: Course) -> Iterator[str]:
    """Each promise to raise, with the cases that test it."""
    for id, promise, cases in _promises(course, Marker(course, 1)):
        tests = ", ".join(f"“{case}”" for case in cases)
        yield f"{id} promises {promise}: tested by {tests or 'nothing'}"


def tried_styles(course: Course) -> Iterator[str]:
    """For each question that has right work in other clothes, in how many styles."""
    if not has_right_work(course):
        yield f"No question is tried with right work in other clothes: there is no {FOLDER}."
        return
    for id, question in course.questions.items():
        if kind_of(question).fewest_variants:
            names = right_work_of(course, question)
            yield f"{id} is tried with right work in {len(names)} other styles."


def _promises(course: Course, marker: Marker) -> Iterator[tuple[str, str, list[str]]]:
    for id, answer in course.key.items():
        kind = kind_of(course.question(id))
        for promise, cases in kind.promises(answer, course.root, marker.drawn(id)):
            yield id, promise, cases


def _mutants(course: Course, question: Question, findings: Findings) -> Iterator[str]:
    declared = {entry.mutant: entry for entry in course.key[question.id].equivalent}
    for survivor in findings.survivors:
        if not any(_means(name, survivor.mutant.name) for name in declared):
            yield _told(course, question, survivor)
    surviving = [survivor.mutant.name for survivor in findings.survivors]
    for name in declared:
        if any(_means(name, other) for other in surviving):
            continue
        if any(_means(name, other) for other in findings.names):
            problem = f"the mutant {name!r} is told apart by the cases; remove it from equivalent."
        else:
            problem = f"there is no mutant {name!r}; correct or remove it in equivalent."
        yield with_line(course, question, problem)


def _means(declared: str, name: str) -> bool:
    """Whether a declaration is about a mutant; a star at its end stands for any rest."""
    if declared.endswith("*"):
        return name.startswith(declared[:-1])
    return name == declared


def _told(course: Course, question: Question, survivor: Survivor) -> str:
    mutant = survivor.mutant
    rows = "\n".join(f"    {row}" for row in mutant.diff.splitlines())
    todo = "Add a case that tells it from the right response, or declare it in equivalent."
    name = json.dumps(mutant.name, ensure_ascii=False)  # a string of TOML too
    return (
        f"a mutant earns everything ({mutant.operator}): {mutant.name}\n{rows}\n"
        f"    It passed {', '.join(survivor.passed)}. "
        f"{with_line(course, question, todo).rstrip('.')}:\n"
        f'    {{mutant = {name}, why = "..."}}'
    )


def _variants(course: Course, question: Question, findings: Findings) -> Iterator[str]:
    for name, problem in sorted(findings.variants.items()):
        if problem:
            yield f"the variant {name} must earn everything, but {problem}"
    fewest = kind_of(question).fewest_variants
    if has_right_work(course) and len(findings.variants) < fewest:
        yield (
            f"{FOLDER} has right work in {len(findings.variants)} other styles; "
            f"write at least {fewest}."
        )
