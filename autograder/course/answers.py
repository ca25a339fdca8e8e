"""The key to the questions, read from ``solutions/answers/*.toml``. Never shipped to students.

What an answer has beyond an explanation, code and alternatives is the business of its kind.
"""

from __future__ import annotations

from collections.abc import Mapping

from autograder.course.placeholders import NotFilled, fill
from autograder.questions.answer import Alternative, Answer
from autograder.questions.question import Question
from autograder.questions.registry import kind_of
from autograder.questions.strict_reader import Place, path_of, read_table

__all__ = ["Alternative", "Answer", "answer_from_table"]


def answer_from_table(
    table: dict[str, object],
    question: Question,
    text: str = "",
    numbers: Mapping[str, int | float] | None = None,
) -> Answer:
    """Read the key to one question; ``text`` is that of its file, for the lines of errors.

    ``numbers`` are those of the question's variant, if it has variables.

    Raises:
        CourseError: if the table does not fit the question; the sentence says where and why.
    """
    words = f"the answer to {question.id} in solutions/answers/{question.chapter}.toml"
    place = Place(words, text, (question.id,))
    kind = kind_of(question)
    if numbers is not None and isinstance(table, dict):
        try:
            table = fill(table, numbers, kind.formulas)
        except NotFilled as error:
            raise error.at(place) from None
    answer = read_table(table, kind.answer_type, place, id=question.id)
    try:
        kind.check_answer(question, answer)
    except ValueError as error:
        raise place.error(str(error), path_of(error)) from None
    return answer
