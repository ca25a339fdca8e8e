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
import re
from collections.abc import Callable, Iterator
from pathlib import Path

from autograder.authoring.build import build_student_notebooks, unexecuted_solved_notebooks
from autograder.authoring.line_in_key import with_line
from autograder.authoring.proof_by_mutants import prove_by_mutants, untested_promises
from autograder.authoring.proof_for_students import prove_for_students
from autograder.authoring.proof_of_texts import prove_texts
from autograder.authoring.proof_of_variants import prove_variants
from autograder.course import Course, load_course
from autograder.course.answers import Answer
from autograder.course.folders import ANSWERS, MASTERS, NOTEBOOKS, QUESTIONS, SOLVED, cell_id
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
TELLING_DIGITS = 3


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
    problems = [*_misplaced_files(course), *prove_texts(course), *prove_for_students(course)]
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
    problems += _leaks(course, [built.text for built in untouched])
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


def _misplaced_files(course: Course) -> Iterator[str]:
    chapters = {f"{chapter.name}.toml" for chapter in course.chapters}
    masters = {path.stem for path in (course.root / MASTERS).glob("*.py")}
    notebooks = {f"{stem}.ipynb" for stem in masters}
    expected = {
        QUESTIONS: chapters,
        ANSWERS: chapters,
        MASTERS: {f"{stem}.py" for stem in masters},
        NOTEBOOKS: notebooks,
        SOLVED: notebooks,
    }
    for folder, names in expected.items():
        for path in sorted((course.root / folder).glob("*")):
            generated = path.name in ("responses", "submission.zip", "__pycache__")
            module = path.suffix == ".py" and folder == NOTEBOOKS
            if path.is_dir() or path.name.startswith(".") or generated or module:
                continue
            if path.name not in names:
                yield (
                    f"{path.relative_to(course.root)} is unexpected; "
                    "remove it, or add the chapter that it belongs to."
                )


def _leaks(course: Course, student_notebooks: list[str]) -> Iterator[str]:
    """Parts of the key that stand in what students get: the notebooks and all beside them."""
    texts = {
        str(path.relative_to(course.root)): path.read_text(encoding="utf-8")
        for path in sorted((course.root / NOTEBOOKS).rglob("*"))
        if path.suffix in (".py", ".toml", ".md", ".js") and "responses" not in path.parts
    }
    for text in student_notebooks:
        cells = json.loads(text)["cells"]
        title = "".join(cells[0]["source"]).partition("\n")[0].strip("# ")
        texts[f"the notebook “{title}”"] = "\n".join("".join(cell["source"]) for cell in cells)
    for id, answer in course.key.items():
        question = course.questions[id]
        kind = kind_of(question)
        patterns = [re.escape(s) for s in kind.secrets(question, answer) if len(s) > 8]
        own = "\n".join([question.title, question.prompt, *question.hints])
        for number in kind.secret_numbers(question, answer):
            pattern = rf"(?<![\w.]){re.escape(number)}(?![\w]|\.\d)"
            # A short number stands in many places and gives nothing away but in its own question.
            if sum(sign.isdigit() for sign in number) >= TELLING_DIGITS:
                patterns.append(pattern)
            elif re.search(pattern, own):
                yield f"{id}: its own text contains {number!r}, which is in the key."
        for pattern in patterns:
            for name, text in texts.items():
                found = re.search(pattern, text)
                if found:
                    yield f"{id}: {name} contains {found[0][:60]!r}, which is in the key."
