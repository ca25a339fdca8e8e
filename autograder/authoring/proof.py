"""``autograder check``: the course proves itself.

What is proven: every question is asked once and has a key; its texts say what was typed; its
reference runs on every case; the solved notebooks earn every point and the untouched ones none;
each known mistake is told apart from the right response and from the other mistakes by the very
inputs that grade; each mutant of what is right loses credit, and right work in other clothes earns
all; what a docstring promises to raise is asked for; no answer stands in what students get; no file
is out of place.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path

from autograder.authoring.build import build_student_notebooks, unexecuted_solved_notebooks
from autograder.authoring.key_told_to_students import parts_of_key_told
from autograder.authoring.line_in_key import with_line
from autograder.authoring.misplaced_files import misplaced_files
from autograder.authoring.proof_by_mutants import prove_by_mutants, untested_promises
from autograder.authoring.proof_for_students import prove_for_students
from autograder.authoring.proof_of_drawn_numbers import prove_variants
from autograder.authoring.proof_of_texts import prove_texts
from autograder.course import Course, load_course
from autograder.course.answers import Answer
from autograder.course.folders import cell_id
from autograder.course.questions import Question
from autograder.errors import AutograderError
from autograder.grading.submission import grade_contents
from autograder.intake.submissions import Contents, Notebook
from autograder.marking.marker import Marker
from autograder.questions.registry import kind_of
from autograder.reports.pictures import Pictures
from autograder.sandbox.launcher import Sandbox

# Hidden inputs are random: what holds for one draw must hold for others.
SEEDS = (1, 2, 3)


def prove_course(
    root: Path | None = None,
    report: Callable[[str], None] = lambda step: None,
    mutants: bool = True,
) -> list[str]:
    """Every problem of the course at ``root``, one sentence each; none if the course is sound.

    ``report`` is called with the name of each step before it begins. Without ``mutants`` it is not
    asked whether every mutant of what is right loses credit, which takes longest.
    """
    report("questions and answers")
    try:
        course = load_course(root)
        key = course.key
        solved, untouched = unexecuted_solved_notebooks(course), build_student_notebooks(course)
    except AutograderError as error:
        return [str(error)]
    problems = [*misplaced_files(course), *prove_texts(course), *prove_for_students(course)]
    report("mistakes")
    for question in course.questions.values():
        try:
            found = [*_prove_answer(course, question, key[question.id])]
        except AutograderError as error:
            found = [f"{question.id}: {error}"]
        problems += [with_line(course, question, problem) for problem in found]
    if problems:
        return problems
    pictures = Pictures(course)
    problems += [
        with_line(course, course.question(id), f"{id}: {problem}")
        for id in key
        if (problem := pictures.problem(id, SEEDS[0]))
    ]
    if course.varied:
        report("variants")
        problems += prove_variants(course)
    if mutants:
        try:
            problems += prove_by_mutants(course, report)
        except AutograderError as error:
            return [str(error)]
    report("leaks")
    problems += parts_of_key_told(course, [built.text for built in untouched])
    marker = Marker(course, SEEDS[0])
    problems += untested_promises(course, marker)
    with Sandbox(course) as sandbox:
        report("solved notebooks")
        for mark in grade_contents(_contents([b.text for b in solved], course), marker, sandbox):
            by_hand = kind_of(course.questions[mark.question]).by_hand
            if mark.status != ("recorded" if by_hand else "right"):
                said = " ".join(filter(None, (mark.feedback, mark.told)))
                problem = f"{mark.question}: the solved notebook is marked {mark.status}: {said}"
                problems.append(with_line(course, course.questions[mark.question], problem))
        report("untouched notebooks")
        for mark in grade_contents(_contents([b.text for b in untouched], course), marker, sandbox):
            if mark.status != "not attempted":
                problems.append(
                    f"{mark.question}: the untouched stub is marked {mark.status}; "
                    "it must be not attempted."
                )
    return problems


def _contents(texts: list[str], course: Course) -> Contents:
    """Notebooks as if they had been handed in; the file names are those of the chapters."""
    notebooks = {}
    for text in texts:
        cells = json.loads(text)["cells"]
        code = ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]
        asked = {cell["id"] for cell in cells}
        for chapter in course.chapters:
            if any(cell_id(x.id, "response") in asked for x in chapter.questions):
                notebooks[chapter.name] = Notebook(cells=code, receipts={})
    return Contents(notebooks)


def _prove_answer(course: Course, question: Question, answer: Answer) -> Iterator[str]:
    kind = kind_of(question)
    for problem in kind.problems(question, answer):
        yield f"{question.id}: {problem}"
    found: dict[str, None] = {}  # a problem that several draws show is told once
    for seed in SEEDS:
        marker = Marker(course, seed)
        for problem in kind.unsound(question, answer, marker.drawn(question.id), course.root):
            found[f"{question.id}: {problem}"] = None
        for alternative in answer.alternatives:
            response = kind.response_like(question, alternative, marker.drawn(question.id))
            if response is None:
                continue
            mark = marker.mark(question.id, response)
            if mark.alternative != alternative.name:
                taken = f"taken for {mark.alternative!r}" if mark.alternative else "not recognised"
                found[
                    f"{question.id}: the alternative {alternative.name!r} is {taken} "
                    f"and gets {mark.credit:g} credit; "
                    "correct it, or choose inputs that tell the two apart."
                ] = None
    yield from found
