"""What is asked, read from ``notebooks/questions/*.toml``. These files go to students.

What a question has beyond an id, a title, a prompt and hints is the business of its kind.
"""

from __future__ import annotations

from typing import Any

from autograder.kinds.question import Question
from autograder.kinds.registry import has_kind, kind_named, kind_names
from autograder.kinds.strict import Place, read_table

__all__ = ["Question", "question_from_table"]


def question_from_table(
    table: dict[str, Any], chapter: str, text: str = "", position: int = 0
) -> Question:
    """Read one ``[[question]]`` table: the one at ``position`` in the ``text`` of its file.

    Raises:
        CourseError: if a field is missing, unknown or of the wrong type; the sentence names the
            question, the field, the file and, given its text, the line.
    """
    words = f"question {table.get('id', '?')!r} in notebooks/questions/{chapter}.toml"
    place = Place(words, text, ("question", position))
    name = table.get("kind")
    if not isinstance(name, str) or not has_kind(name):
        raise place.error(f"kind {name!r} is not one of {', '.join(kind_names())}", ("kind",))
    return read_table(table, kind_named(name).question_type, place, chapter=chapter)
