"""``ask``, ``check``, ``progress`` and ``submit``."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import Any

from autograder.course import Course, find_course_root, load_course
from autograder.errors import AutograderError, UsageError
from autograder.marking.mark import Mark, not_attempted, stopped
from autograder.marking.order import fits_order
from autograder.marking.true_false import fits_true_false
from autograder.questions import Order, Question, TrueFalse
from autograder.sandbox.evaluate import describe, evaluate
from autograder.student.marker_client import marker_for
from autograder.student.responses import Responses, responses_folder
from autograder.student.submission import pack_submission
from autograder.student.views import MarkView, ProgressView, QuestionView, SubmissionView

MISSING: Any = object()


@lru_cache(maxsize=1)
def _course_at(root: Path) -> Course:
    return load_course(root)


def _course() -> Course:
    return _course_at(find_course_root())


def _responses(course: Course, chapter: str) -> Responses:
    return Responses(responses_folder(course.root), chapter)


class Asked(QuestionView):
    """A question on show; ``respond`` answers it."""

    def respond(self, response: Any) -> MarkView | None:
        """Record a response and mark it.

        A true/false question takes a list of True, False or None; an order question a list of
        card ids or of the numbers shown beside the cards; any other the value itself.
        """
        return _try(lambda: _respond(self.question.id, response))


def ask(id: str) -> Asked | None:
    """Show a question.

    Args:
        id: such as ``"Q1.1"``.
    """
    return _try(lambda: _ask(id))


def check(id: str, response: Any = MISSING) -> MarkView | None:
    """Mark a response: a value, an expression or a function, as the question asks.

    For a true/false or an order question, leave the response out: what was answered there is
    marked.
    """
    return _try(lambda: _check(id, response))


def progress() -> ProgressView | None:
    """Show the points so far, chapter by chapter."""
    return _try(lambda: _progress())


def submit() -> SubmissionView | None:
    """Pack the notebooks and responses into ``submission.zip`` and say what is unanswered."""
    return _try(lambda: _submit())


def _try(action: Any) -> Any:
    """Say what is wrong in one sentence: a traceback would bury it."""
    try:
        return action()
    except AutograderError as error:
        print(error)
        return None


def _ask(id: str) -> Asked:
    course = _course()
    question = course.question(id)
    marker_for(course)  # starts marking in the background while the student reads
    entry = _responses(course, question.chapter).get(id)
    return Asked(question, entry.get("response"))


def _respond(id: str, response: Any) -> MarkView:
    course = _course()
    question = course.question(id)
    if not isinstance(question, TrueFalse | Order):
        return _check(id, response)
    chosen = _read_choice(question, response)
    mark = _mark_choice(course, question, chosen)
    _record(course, question, mark, chosen)
    return MarkView(question, mark, chosen)


def _check(id: str, response: Any) -> MarkView:
    course = _course()
    question = course.question(id)
    if isinstance(question, TrueFalse | Order):
        if response is not MISSING:
            return _respond(id, response)
        chosen = _responses(course, question.chapter).get(id).get("response")
        return MarkView(question, _mark_choice(course, question, chosen), chosen)
    if response is MISSING:
        raise UsageError(f'Give your response too: check("{id}", {question.name}).')
    marker = marker_for(course)
    understood = "" if response is ... else describe(response)
    if response is ... or marker is None:
        # Without a key an untouched stub is still told from a response.
        untouched = response is ... or _is_stub(response)
        mark = not_attempted(question) if untouched else stopped(question, "recorded")
    else:
        reply = evaluate(response, marker.probe(id))
        mark = marker.mark(id, reply, understood)
    if mark.status != "not attempted":
        _record(course, question, mark, None, understood)
    return MarkView(question, mark, None)


def _is_stub(response: Any) -> bool:
    """Whether a function still only raises NotImplementedError, as the handout's stub does."""
    code = getattr(response, "__code__", None)
    return code is not None and code.co_names == ("NotImplementedError",)


def _untouched(question: Question, chosen: list[Any]) -> bool:
    """Whether every statement is still open, or the cards lie as they were dealt."""
    if isinstance(question, Order):
        return tuple(chosen) == question.start
    return all(said is None for said in chosen)


def _mark_choice(course: Course, question: Question, chosen: Any) -> Mark:
    if chosen is None:
        return not_attempted(question)
    marker = marker_for(course)
    if marker is None:
        # Without a key untouched work is still told from a response.
        return (
            not_attempted(question)
            if _untouched(question, chosen)
            else stopped(question, "recorded")
        )
    return marker.mark(question.id, chosen)


def _read_choice(question: TrueFalse | Order, response: Any) -> list[Any]:
    """The response in the form in which it is kept.

    Raises:
        UsageError: if it does not fit the question.
    """
    response = list(response) if isinstance(response, list | tuple) else response
    if isinstance(question, TrueFalse):
        if not fits_true_false(question, response):
            count = len(question.statements)
            raise UsageError(
                f"{question.id} has {count} statements: respond with a list of {count} True or "
                "False (None leaves one open). Nothing was changed."
            )
        return response
    if isinstance(response, list) and all(
        isinstance(n, int) and 1 <= n <= len(question.cards) for n in response
    ):
        response = [question.start[n - 1] for n in response]
    if not fits_order(question, response):
        raise UsageError(
            f"{question.id} has {len(question.cards)} cards: respond with a list that names each "
            "card once, by the number or the id shown beside it. Nothing was changed."
        )
    return response


def _record(
    course: Course, question: Question, mark: Mark, response: Any, understood: str = ""
) -> None:
    _responses(course, question.chapter).record(
        question.id,
        {
            "kind": question.kind,
            "response": response,
            "understood": understood,
            "status": mark.status,
            "points": mark.points,
        },
    )


def _progress() -> ProgressView:
    course = _course()
    return ProgressView(
        course,
        {chapter.name: _responses(course, chapter.name).all() for chapter in course.chapters},
    )


def _submit() -> SubmissionView:
    course = _course()
    folder = responses_folder(course.root)
    packed = pack_submission(course, folder)
    answered = {
        id
        for chapter in course.chapters
        for id, entry in Responses(folder, chapter.name).all().items()
        if entry.get("status") != "not attempted"
    }
    unanswered = [question for question in course.questions.values() if question.id not in answered]
    return SubmissionView(packed, unanswered, len(course.questions))
