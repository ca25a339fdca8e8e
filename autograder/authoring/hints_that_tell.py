"""Hints and feedback that hold the answer, or help nobody.

A hint may help with the next step, feedback may name the error in thinking; neither may hold the
whole right formula, code or value, however it is typed.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from autograder.course.questions import Question
from autograder.questions.answer import Answer
from autograder.questions.author_tables import second_of
from autograder.questions.registry import kind_of
from autograder.questions.toml_lines import Path

_BLANKS = re.compile(r"\s+")
_PARTS = re.compile(r"\w+|\*\*|\S")  # of a formula
# How one formula is typed in Python, in Markdown and in TeX.
_SIGNS = ((r"\cdot", "*"), ("·", "*"), ("×", "*"), ("^", "**"), ("{", "("), ("}", ")"), ("$", ""))
_MANY_DIGITS = 3  # of a value that a hint may not hold: twelve is also a number of steps
_SHORTEST = 5  # signs of a formula that a hint may not hold; shorter ones stand in any sentence


def problems_of_hints(question: Question, answer: Answer) -> Iterator[tuple[str, Path]]:
    """Each problem of what is asked, and the path to the field that has it."""
    hints = [on_one_line(hint) for hint in question.hints]
    if (twice := second_of(hints)) is not None:
        yield "this hint stands there already; let each tell a little more", ("hints", twice)
    for position, hint in enumerate(hints):
        path = ("hints", position)
        if hint == on_one_line(question.prompt):
            yield "this hint only says the prompt again; help with the first step", path
        elif told := (
            _right_text_in(question, answer, hint)
            or _right_value_in(question, answer, hint, digits=_MANY_DIGITS)
        ):
            yield f"this hint holds the whole answer, {told!r}; help with the next step only", path


def problems_of_feedback(question: Question, answer: Answer) -> Iterator[tuple[str, Path]]:
    """The same for what a student reads who has made a mistake, and may try again."""
    for position, entry in enumerate(answer.alternatives):
        text = entry.feedback
        told = _right_text_in(question, answer, text) or _right_value_in(question, answer, text)
        if entry.is_mistake and told:
            yield (
                f"the feedback of {entry.name!r} holds the whole answer, {told!r}; name the error "
                "in thinking, and what to look at next",
                ("alternative", position, "feedback"),
            )


def _right_text_in(question: Question, answer: Answer, hint: str) -> str:
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


def _right_value_in(question: Question, answer: Answer, text: str, digits: int = 2) -> str:
    """The right value that a text holds, as it is printed with so many digits; or nothing."""
    for value in kind_of(question).secret_numbers(question, answer):
        long = sum(sign.isdigit() for sign in value) >= digits  # few stand in many a text
        if long and re.search(rf"(?<![\w.]){re.escape(value)}(?!\w|\.\d)", text):
            return value
    return ""


def _plain_signs(text: str) -> str:
    for sign, plain in _SIGNS:
        text = text.replace(sign, plain)
    return text


def on_one_line(text: str) -> str:
    """The text with one blank for each run of blanks and ends of lines."""
    return _BLANKS.sub(" ", text).strip()
