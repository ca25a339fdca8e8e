"""What is sound by itself and serves no student: read from the tables, before anything is run.

A question is refused here if a student could not tell it from another one, could not tell its own
parts apart, would be told its answer by a hint, or would overwrite what the notebook needs. What
only the key's own kind can say is among that kind's `problems`.
"""

from __future__ import annotations

from collections.abc import Iterator

from autograder.authoring.hints_that_tell import (
    on_one_line,
    problems_of_feedback,
    problems_of_hints,
)
from autograder.authoring.names_taken import names_taken
from autograder.course import Course
from autograder.course.folders import ANSWERS
from autograder.course.questions import Question, Written
from autograder.questions.registry import kind_of
from autograder.questions.strict_reader import Place


def prove_for_students(course: Course) -> Iterator[str]:
    """One sentence for each thing that an author would not want a student to meet."""
    asked: dict[object, str] = {}
    taken = names_taken(course)
    for chapter in course.chapters:
        text, _ = course.answer_tables[chapter.name]
        for question, written in zip(chapter.questions, chapter.written, strict=True):
            answer = course.key[question.id]
            for problem, path in problems_of_hints(question, answer):
                yield str(written.place.error(problem, path))
            if why := taken.get(chapter.name, {}).get(question.name or ""):
                field = next(key for key, said in written.table.items() if said == question.name)
                problem = f"{question.name!r} is taken in the notebook: {why}; choose another name"
                yield str(written.place.error(problem, (field,)))
            of_key = f"the answer to {question.id} in {ANSWERS.as_posix()}/{chapter.name}.toml"
            for problem, path in problems_of_feedback(question, answer):
                yield str(Place(of_key, text, (question.id,)).error(problem, path))
            same = asked.setdefault(_all_that_is_asked(question, written), question.id)
            if same != question.id:
                problem = f"it asks the very same as {same}; say in its prompt how they differ"
                yield str(written.place.error(problem, ("prompt",)))


def _all_that_is_asked(question: Question, written: Written) -> object:
    """What tells a question from others: its prompt, and what is to be chosen from."""
    listed = kind_of(question).drawn_fields[0]
    return (on_one_line(question.prompt), repr(written.table.get(listed)) if listed else "")
