"""What is sound by itself and serves no student: read from the tables, before anything is run.

A question is refused here if a student could not tell it from another one, could not tell its own
parts apart, would be told its answer by a hint, or would overwrite what the notebook needs. What
only the key's own kind can say is among that kind's `problems`.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from autograder import __all__
from autograder.authoring.masters import read_masters
from autograder.course import Course
from autograder.course.folders import ANSWERS
from autograder.course.questions import Question, Written
from autograder.questions.answer import Answer
from autograder.questions.author_tables import second_of
from autograder.questions.registry import kind_of
from autograder.questions.strict_reader import Place
from autograder.questions.toml_lines import Path

_BLANKS = re.compile(r"\s+")
_PARTS = re.compile(r"\w+|\*\*|\S")  # of a formula
# How one formula is typed in Python, in Markdown and in TeX.
_SIGNS = ((r"\cdot", "*"), ("·", "*"), ("×", "*"), ("^", "**"), ("{", "("), ("}", ")"), ("$", ""))
_SHORTEST = 5  # signs of a formula that a hint may not hold; shorter ones stand in any sentence


def prove_for_students(course: Course) -> Iterator[str]:
    """One sentence for each thing that an author would not want a student to meet."""
    asked: dict[object, str] = {}
    taken = _of_notebook(course)
    for chapter in course.chapters:
        text, _ = course.answer_tables[chapter.name]
        for question, written in zip(chapter.questions, chapter.written, strict=True):
            answer = course.key[question.id]
            for problem, path in _problems(question, answer):
                yield str(written.place.error(problem, path))
            if why := taken.get(chapter.name, {}).get(question.name or ""):
                field = next(key for key, said in written.table.items() if said == question.name)
                problem = f"{question.name!r} is taken in the notebook: {why}; choose another name"
                yield str(written.place.error(problem, (field,)))
            of_key = f"the answer to {question.id} in {ANSWERS.as_posix()}/{chapter.name}.toml"
            for problem, path in _problems_of_key(question, answer):
                yield str(Place(of_key, text, (question.id,)).error(problem, path))
            same = asked.setdefault(_all_that_is_asked(question, written), question.id)
            if same != question.id:
                problem = f"it asks the very same as {same}; say in its prompt how they differ"
                yield str(written.place.error(problem, ("prompt",)))


def _all_that_is_asked(question: Question, written: Written) -> object:
    """What tells a question from others: its prompt, and what is to be chosen from."""
    listed = kind_of(question).drawn_fields[0]
    return (_plain(question.prompt), repr(written.table.get(listed)) if listed else "")


def _problems(question: Question, answer: Answer) -> Iterator[tuple[str, Path]]:
    """Each problem of what is asked, and the path to the field that has it."""
    hints = [_plain(hint) for hint in question.hints]
    if (twice := second_of(hints)) is not None:
        yield "this hint stands there already; let each tell a little more", ("hints", twice)
    for position, hint in enumerate(hints):
        path = ("hints", position)
        if hint == _plain(question.prompt):
            yield "this hint only says the prompt again; help with the first step", path
        elif told := _told(question, answer, hint):
            yield f"this hint holds the whole answer, {told!r}; help with the next step only", path


def _problems_of_key(question: Question, answer: Answer) -> Iterator[tuple[str, Path]]:
    """The same for what a student reads who has made a mistake, and may try again."""
    for position, entry in enumerate(answer.alternatives):
        told = _told(question, answer, entry.feedback) or _value(question, answer, entry.feedback)
        if entry.is_mistake and told:
            yield (
                f"the feedback of {entry.name!r} holds the whole answer, {told!r}; name the error "
                "in thinking, and what to look at next",
                ("alternative", position, "feedback"),
            )


def _of_notebook(course: Course) -> dict[str, dict[str, str]]:
    """For each chapter the names that its notebook has from elsewhere, and what brings them."""
    names: dict[str, dict[str, str]] = {}
    for master in read_masters(course):
        if master.chapter is not None:
            brought = dict.fromkeys(__all__, "the notebook calls it to ask and to check")
            for cell in master.cells:
                brought |= _imported(cell.source) if cell.kind == "code" else {}
            names[master.chapter.name] = brought
    return names


def _imported(source: str) -> dict[str, str]:
    try:
        tree = ast.parse(source)
    except SyntaxError:  # a line for IPython
        return {}
    return {
        (alias.asname or alias.name).partition(".")[0]: f"its cells import it: {ast.unparse(node)}"
        for node in ast.walk(tree)
        if isinstance(node, ast.Import | ast.ImportFrom) and _module(node) != "autograder"
        for alias in node.names
    }


def _module(node: ast.Import | ast.ImportFrom) -> str | None:
    return node.module if isinstance(node, ast.ImportFrom) else None


def _told(question: Question, answer: Answer, hint: str) -> str:
    """The right formula or code of the key that a hint holds, whatever its blanks; or nothing."""
    said = _plain_signs(hint)
    for right in kind_of(question).right_texts(answer):
        parts = _PARTS.findall(_plain_signs(right))
        if len("".join(parts)) < _SHORTEST or not re.search(r"[-+*/(]", right):
            continue
        # In a sentence the sign of multiplication is often left out: 2(a + b).
        formula = r"\s*".join(r"\*?" if part == "*" else re.escape(part) for part in parts)
        if re.search(rf"(?<![\w.]){formula}(?![\w(]|\.\d|\s*\*\*)", said):
            return right
    return ""


def _value(question: Question, answer: Answer, text: str) -> str:
    """The right value that a text holds, as it is printed; or nothing."""
    for value in kind_of(question).secret_numbers(question, answer):
        long = sum(sign.isdigit() for sign in value) > 1  # a single digit stands in many a text
        if long and re.search(rf"(?<![\w.]){re.escape(value)}(?!\w|\.\d)", text):
            return value
    return ""


def _plain_signs(text: str) -> str:
    for sign, plain in _SIGNS:
        text = text.replace(sign, plain)
    return text


def _plain(text: str) -> str:
    return _BLANKS.sub(" ", text).strip()
