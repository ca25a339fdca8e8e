"""The key to the questions, read from ``solutions/answers/*.toml``. Never shipped to students.

What an answer has beyond an explanation, code and alternatives is the business of its kind.
"""

from __future__ import annotations

from typing import Any

from autograder.errors import CourseError
from autograder.kinds.answer import Alternative, Answer, Equivalent
from autograder.kinds.question import Question
from autograder.kinds.registry import kind_of
from autograder.kinds.toml_table import Table

__all__ = ["Alternative", "Answer", "answer_from_table"]


def answer_from_table(table: dict[str, Any], question: Question) -> Answer:
    """Read the key to one question.

    Raises:
        CourseError: if the table does not fit the question; the sentence says where and why.
    """
    where = f"the answer to {question.id} in solutions/answers/{question.chapter}.toml"
    if not isinstance(table, dict):
        raise CourseError(f"{where} must be a table.")
    read = Table(table, where)
    common: dict[str, Any] = {
        "id": question.id,
        "explanation": read.text("explanation", ""),
        "code": read.text("code", ""),
        "snapshot": read.take("snapshot", bool, True),
    }
    declared = read.tables("equivalent", "equivalent", [])
    common["equivalent"] = tuple(
        Equivalent(entry.text("mutant"), entry.text("why")) for entry in declared
    )
    tables = read.tables("alternative", "alternative", [])
    answer: Answer = kind_of(question).read_answer(question, read, tables, common)
    for entry in (read, *declared, *tables):
        entry.done()
    names = [alternative.name for alternative in answer.alternatives]
    if len(set(names)) != len(names):
        raise CourseError(f"{where}: two alternatives have the same name.")
    for alternative in answer.alternatives:
        if alternative.is_mistake and not alternative.feedback:
            raise CourseError(f"{where}: the mistake {alternative.name!r} has no feedback.")
    return answer
