"""Ids and variables that are used twice."""

from __future__ import annotations

from autograder.course.course import Chapter
from autograder.course.folders import (
    QUESTIONS,
)
from autograder.questions.strict_reader import Place


def reject_what_is_used_twice(chapters: list[Chapter]) -> None:
    """Refuse two questions or predictions with one id, and two responses with one name.

    Raises:
        CourseError: at the first; the sentence names the file and the line.
    """
    placed: dict[str, str] = {}
    predicted: set[str] = set()
    for chapter in chapters:
        file = f"{chapter.name}.toml"
        text = next((written.text for written in chapter.written), "")
        for number, prediction in enumerate(chapter.predictions):
            if prediction.id in predicted:
                words = f"prediction {prediction.id!r} in {(QUESTIONS / file).as_posix()}"
                place = Place(words, text, ("prediction", number))
                raise place.error("two predictions have this id; rename one", ("id",))
            predicted.add(prediction.id)
        stored: dict[str, str] = {}
        for question, written in zip(chapter.questions, chapter.written, strict=True):
            if question.id in placed:
                files = " and ".join(dict.fromkeys([placed[question.id], file]))
                raise written.place.error(
                    f"two questions have this id (in {files}); rename one", ("id",)
                )
            placed[question.id] = file
            if question.name is None:
                continue
            if question.name in stored:
                field = next(key for key, value in written.table.items() if value == question.name)
                raise written.place.error(
                    f"{stored[question.name]} and {question.id} both store their response in "
                    f"{question.name!r}; rename one, or the later cell would overwrite the earlier",
                    (field,),
                )
            stored[question.name] = question.id
