"""Another one: the widget of a fresh variant, or of functions to read."""

from __future__ import annotations

import secrets
from collections.abc import Callable

from autograder.course.questions import Question
from autograder.errors import UsageError
from autograder.language import _
from autograder.questions.registry import kind_of
from autograder.student.desk import Desk
from autograder.student.marker_client import key_marker
from autograder.student.practice.desk import MOST_TRIED, PracticeDesk, can_be_read, has_variants
from autograder.student.widgets.base import CourseWidget

OnResult = Callable[[bool], object]


def can_practise(desk: Desk, question: Question) -> bool:
    """Whether there is another one of a question here: it needs the key, and something to vary."""
    return has_variants(desk, question) or can_be_read(desk, question)


def another_one(
    desk: Desk, question: Question, on_result: OnResult = lambda right: None, unlike: int = -1
) -> CourseWidget:
    """A widget with a fresh variant; ``on_result`` is told of each response whether it was right.

    ``unlike`` is the variant that was practised last. A question without variants is asked again
    as it is.

    Raises:
        UsageError: if there is no key to mark it with.
        CourseError: if the key is broken.
    """
    client = key_marker(desk.course, question.id)
    if client is None:
        sentence = _("{question} cannot be practised here: its key is not at hand.")
        raise UsageError(sentence.format(question=question.id))
    if can_be_read(desk, question):
        from autograder.student.widgets.reading import ReadingWidget

        return ReadingWidget(desk, question, client, secrets.randbits(31), on_result)
    variant = _fresh(desk, question.id, unlike) if question.id in desk.course.varied else 0
    fresh = PracticeDesk(
        desk, question.id, variant, client, lambda mark: on_result(mark.status == "right")
    )
    widget: CourseWidget = kind_of(question).widget(fresh, fresh.question)
    return widget


def _fresh(desk: Desk, id: str, unlike: int) -> int:
    """Any variant that asks something else than the student's own and the last one, if it can."""
    written = desk.course.varied[id]
    assert written.variables is not None
    asked = [written.question(n) for n in (desk.course.variants.get(id, 0), unlike) if n >= 0]
    variant = 0
    for _try in range(MOST_TRIED):
        variant = secrets.randbelow(written.variables.count)
        if written.question(variant) not in asked:
            break
    return variant
