"""What is asked, read from ``notebooks/questions/*.toml``. These files go to students.

What a question has beyond an id, a title, a prompt, hints and points is the business of its kind.
"""

from __future__ import annotations

import re
from typing import Any

from autograder.errors import CourseError
from autograder.kinds.question import Question
from autograder.kinds.registry import has_kind, kind_named, kind_names
from autograder.kinds.toml_table import Table

__all__ = ["Question", "question_from_table"]

_ID = re.compile(r"Q\d+(\.\d+)*[a-z]?\d?")


def question_from_table(table: dict[str, Any], chapter: str) -> Question:
    """Read one ``[[question]]`` table.

    Raises:
        CourseError: if a field is missing, unknown or of the wrong type; the sentence names the
            question, the field and the file.
    """
    where = f"question {table.get('id', '?')!r} in notebooks/questions/{chapter}.toml"
    read = Table(table, where)
    name = table.get("kind")
    if not isinstance(name, str) or not has_kind(name):
        raise CourseError(f"{where}: kind {name!r} is not one of {', '.join(kind_names())}.")
    kind = kind_named(read.text("kind"))
    if not _ID.fullmatch(read.take("id", str)):
        raise read.error("an id looks like Q3.2.1 or Q2.2a")
    common: dict[str, Any] = {
        "id": read.text("id"),
        "chapter": chapter,
        "title": read.text("title"),
        "prompt": read.text("prompt"),
        "hints": read.some_texts("hints"),
    }
    question = kind.read_question(read, common)
    read.done()
    return question
