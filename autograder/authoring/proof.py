"""``autograder check``: the course proves itself.

What is proven: every question is asked once and has a key; the solved notebooks earn every point
and the untouched ones none; each known mistake is told apart from the right response and from the
other mistakes by the very inputs that grade; no answer stands in what students get; no file is out
of place.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from autograder.authoring.build import build_student_notebooks, unexecuted_solved_notebooks
from autograder.course import ANSWERS, QUESTIONS, Course, load_course
from autograder.course import answers as a
from autograder.course import questions as q
from autograder.course.formula import evaluate_formula
from autograder.errors import AutograderError
from autograder.grading.submission import grade_contents
from autograder.intake.submissions import Contents, Notebook
from autograder.kinds.order.marking import transitive_closure
from autograder.marking import Mark
from autograder.marking.marker import Marker
from autograder.sandbox.launcher import Sandbox

# Hidden inputs are random: what holds for one draw must hold for others.
SEEDS = (1, 2, 3)
FEWEST_MISTAKES = 2


def prove_course(
    root: Path | None = None, report: Callable[[str], None] = lambda step: None
) -> list[str]:
    """Every problem of the course at ``root``, one sentence each; none if the course is sound.

    ``report`` is called with the name of each step before it begins.
    """
    report("questions and answers")
    try:
        course = load_course(root)
        key = course.key
        solved, untouched = unexecuted_solved_notebooks(course), build_student_notebooks(course)
    except AutograderError as error:
        return [str(error)]
    problems = [*_misplaced_files(course)]
    report("mistakes")
    for question in course.questions.values():
        try:
            problems += _prove_answer(course, question, key[question.id])
        except AutograderError as error:
            problems.append(f"{question.id}: {error}")
    if problems:
        return problems
    report("leaks")
    problems += _leaks(course, [built.text for built in untouched])
    marker = Marker(course, SEEDS[0])
    with Sandbox(course) as sandbox:
        report("solved notebooks")
        for mark in grade_contents(_contents([b.text for b in solved], course), marker, sandbox):
            if mark.status != "right":
                problems.append(
                    f"{mark.question}: the solved notebook is marked {mark.status}: {mark.feedback}"
                )
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
            if any(f"{x.id.replace('.', '-')}-response" in asked for x in chapter.questions):
                notebooks[chapter.name] = Notebook(cells=code, receipts={})
    return Contents(notebooks)


def _prove_answer(course: Course, question: q.Question, answer: a.Answer) -> Iterator[str]:
    if isinstance(question, q.Order) and isinstance(answer, a.OrderAnswer):
        yield from _prove_order(question, answer)
    elif not isinstance(question, q.TrueFalse):
        mistakes = [entry for entry in answer.alternatives if entry.is_mistake]
        if len(mistakes) < FEWEST_MISTAKES:
            yield (
                f"{question.id}: {len(mistakes)} known mistakes; "
                f"name at least {FEWEST_MISTAKES}, with feedback."
            )
        if isinstance(answer, a.FunctionAnswer):
            for entry in answer.alternatives:
                if not entry.is_mistake:
                    yield f"{question.id}: the mistake {entry.name!r} gets full credit; lower it."
        elif len(mistakes) == len(answer.alternatives):
            yield f"{question.id}: no alternative has full credit; add the right one."
        for seed in SEEDS if not isinstance(answer, a.NumberAnswer) else SEEDS[:1]:
            for alternative in answer.alternatives:
                mark = _mark_of_alternative(course, question, answer, alternative, seed)
                if mark.alternative != alternative.name:
                    yield (
                        f"{question.id}: the alternative {alternative.name!r} is taken for "
                        f"{mark.alternative!r} and gets {mark.credit:g} credit; "
                        "correct it, or choose inputs that tell the two apart."
                    )


def _mark_of_alternative(
    course: Course, question: q.Question, answer: a.Answer, alternative: a.Alternative, seed: int
) -> Mark:
    """What a response gets that is this alternative."""
    marker = Marker(course, seed)
    probe = marker.probe(question.id)
    response: dict[str, object] = {"state": "given"}
    if isinstance(alternative, a.NumberAlternative):
        response["value"] = alternative.value
    elif isinstance(alternative, a.ExpressionAlternative):
        count = len(next(iter(probe.points.values())))
        values = evaluate_formula(alternative.expression, probe.points)
        response["values"] = np.broadcast_to(values, (count,)).astype(complex)
    else:
        assert probe.expected is not None
        outcomes = {entry.name: found for entry, found in probe.expected.mistakes}
        response["outcomes"] = list(outcomes[alternative.name])
    return marker.mark(question.id, response)


def _prove_order(question: q.Order, answer: a.OrderAnswer) -> Iterator[str]:
    after = transitive_closure(answer.before)
    if not any(
        earlier in after.get(later, ())
        for position, later in enumerate(question.start)
        for earlier in question.start[:position]
    ):
        yield f"{question.id}: the cards are dealt in a right order; shuffle them."
    for entry in answer.alternatives:
        if entry.first not in after.get(entry.second, ()):
            yield (
                f"{question.id}: the mistake {entry.name!r} is none: "
                f"{entry.first!r} may stand before {entry.second!r}."
            )


def _misplaced_files(course: Course) -> Iterator[str]:
    chapters = {f"{chapter.name}.toml" for chapter in course.chapters}
    masters = {path.stem for path in (course.root / "notebooks/source").glob("*.py")}
    notebooks = {f"{stem}.ipynb" for stem in masters}
    expected = {
        QUESTIONS: chapters,
        ANSWERS: chapters,
        Path("notebooks/source"): {f"{stem}.py" for stem in masters},
        Path("notebooks"): notebooks,
        Path("solutions/notebooks"): notebooks,
    }
    for folder, names in expected.items():
        for path in sorted((course.root / folder).glob("*")):
            generated = path.name in ("responses", "submission.zip", "__pycache__")
            module = path.suffix == ".py" and folder == Path("notebooks")
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
        for path in sorted((course.root / "notebooks").rglob("*"))
        if path.suffix in (".py", ".toml", ".md", ".js") and "responses" not in path.parts
    }
    for text in student_notebooks:
        cells = json.loads(text)["cells"]
        title = "".join(cells[0]["source"]).partition("\n")[0].strip("# ")
        texts[f"the notebook “{title}”"] = "\n".join("".join(cell["source"]) for cell in cells)
    for id, answer in course.key.items():
        patterns = [re.escape(secret) for secret in _secrets(answer) if len(secret) > 8]
        question = course.questions[id]
        if isinstance(question, q.Number):
            patterns += [
                rf"(?<![\w.]){re.escape(_printed(question, entry.value))}(?![\w]|\.\d)"
                for entry in answer.alternatives
                if not entry.is_mistake
            ]
        for pattern in patterns:
            for name, text in texts.items():
                found = re.search(pattern, text)
                if found:
                    yield f"{id}: {name} contains {found[0][:60]!r}, which is in the key."


def _secrets(answer: a.Answer) -> Iterator[str]:
    yield answer.explanation
    yield answer.code
    for alternative in answer.alternatives:
        yield alternative.feedback
        if isinstance(alternative, a.ExpressionAlternative) and not alternative.is_mistake:
            yield alternative.expression
    if isinstance(answer, a.TrueFalseAnswer):
        for statement in answer.statements:
            yield statement.explanation
            yield statement.misconception


def _printed(question: q.Number, value: float) -> str:
    return f"{value:.0f}" if question.integer else f"{value:.{question.decimals}f}"
