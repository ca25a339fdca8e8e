"""Where in its key a problem lies that was found by marking, not by reading a file."""

from __future__ import annotations

import re

from autograder.course import Course
from autograder.course.folders import ANSWERS
from autograder.course.questions import Question
from autograder.questions.toml_lines import line_of


def with_line(course: Course, question: Question, problem: str) -> str:
    """A problem of a key with the line that it quotes something of, or with that of its table."""
    file = (ANSWERS / f"{question.chapter}.toml").as_posix()
    text, tables = course.answer_tables[question.chapter]
    first = line_of(text, (question.id,))
    if first is None or file in problem:
        return problem
    begins = [line for id in tables if (line := line_of(text, (id,))) and line > first]
    lines = text.splitlines()[first - 1 : min(begins, default=None)]
    quoted = re.findall(r"'([^']+)'", problem)
    at = next((n for one in quoted for n, line in enumerate(lines) if f'"{one}"' in line), 0)
    return f"{problem.rstrip('.')} ({file}, line {first + at})."
