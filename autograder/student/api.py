"""What a notebook calls: ``ask``, ``check``, ``hint``, ``me``, ``numbers`` and the others."""

from __future__ import annotations

from collections import namedtuple
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path

from autograder.course import Course, load_course
from autograder.errors import AutograderError, UsageError
from autograder.language import _, follow_environment
from autograder.questions.registry import kind_of
from autograder.student import unsaved
from autograder.student.course_path import course_of_notebook, put_course_first
from autograder.student.desk import Desk
from autograder.student.frontend import widgets_wanted
from autograder.student.identity import become, student_of
from autograder.student.live_view import Live, Shown, View
from autograder.student.marker_client import marker_for
from autograder.student.submit import pack_and_say
from autograder.student.views import (
    HintView,
    IdentityView,
    MarkView,
    PracticeView,
    PredictionView,
    ProgressView,
    QuestionView,
)

MISSING: object = object()

put_course_first()
unsaved.watch()
follow_environment()


@lru_cache(maxsize=1)
def _course_at(root: Path) -> Course:
    return load_course(root)


@lru_cache(maxsize=1)
def _desk_at(root: Path, student: str) -> Desk:
    return Desk(_course_at(root).for_student(student), student)


def _desk() -> Desk:
    course = _course_at(course_of_notebook())
    desk = _desk_at(course.root, student_of(course))
    for sentence in desk.mend():
        print(sentence)
    return desk


class Asked(QuestionView):
    """A question on show; ``respond`` answers it."""

    def respond(self, response: object) -> object:
        """Record a response and mark it.

        A true/false question takes a list of True, False or None; an order question a list of
        card ids or of the numbers shown beside the cards; any other the value itself.
        """
        return _try(lambda: _respond(self.question.id, response))


def ask(id: str) -> object:
    """Show a question.

    Args:
        id: such as ``"Q1.1"``.
    """
    return _try(lambda: _ask(id))


def check(id: str, response: object = MISSING) -> object:
    """Mark a response: a value, an expression or a function, as the question asks.

    For a true/false or an order question, leave the response out: what was answered there is
    marked.
    """
    return _try(lambda: _check(id, response))


def hint(id: str) -> object:
    """Open one more hint of a question, and show those that are open.

    Args:
        id: such as ``"Q2.2a"``.
    """
    return _try(lambda: _hint(id))


def me(name: object = MISSING) -> object:
    """Say who you are, by the name or number of the class list; your numbers follow from it.

    Without a name, a field asks for it.
    """
    return _try(lambda: _me(name))


def numbers(story: str) -> object:
    """Return the numbers of a story, by name and in order: ``N, w, p = numbers("cloud")``.

    They are yours where everybody has their own, and else the sheet's.
    """
    return _try(lambda: _numbers(story))


def predict(id: str, value: object = MISSING) -> object:
    """Ask for a prediction, or give one; it is kept and has no points. The first one stands.

    Args:
        id: such as ``"P3.1"``.
        value: a number, or the text or the number (from 1) of a choice; without it, the prediction
            is given by a click or typed into a field.
    """
    return _try(lambda: _predict(id, value))


def predicted(id: str) -> object:
    """Return what was predicted, for a picture to draw beside the truth: None if nothing was.

    Args:
        id: such as ``"P3.1"``.
    """
    return _try(lambda: (desk := _desk()).prediction(desk.course.prediction(id)))


def practise() -> object:
    """Practise what you do not know yet: rounds of ten minutes, marked at once, without points."""
    return _try(lambda: _practise())


def progress() -> object:
    """Show the points so far, chapter by chapter."""
    return _try(lambda: _progress())


def submit(to: str | Path | None = None) -> object:
    """Pack the notebooks and responses into ``submission.zip`` and say what is unanswered.

    Args:
        to: the drop folder of your instructor, if there is one: the file is handed in there too,
            unless something that you ran is not saved.
    """
    return _try(lambda: _submit(Path(to) if to is not None else None))


def _try(action: Callable[[], object]) -> object:
    """Say what is wrong in one sentence: a traceback would bury it."""
    try:
        return action()
    except AutograderError as error:
        print(error)
        return None


def _shown(view: View, widget: Callable[[], Shown]) -> object:
    """The view itself, or a widget where one can be drawn; it is made only to be drawn."""
    return Live(view, widget) if widgets_wanted() else view


def _ask(id: str) -> object:
    desk = _desk()
    question = desk.course.question(id)
    marker_for(desk.course)  # starts marking in the background while the student reads
    view = Asked(question, desk.entry(question).get("response"), desk.whose(question))
    return _shown(view, lambda: kind_of(question).widget(desk, question))


def _respond(id: str, response: object) -> object:
    desk = _desk()
    question = desk.course.question(id)
    if question.name is not None:
        return _check(id, response)
    chosen = kind_of(question).read_response(question, response)
    desk.keep(question, lambda before: chosen)
    return MarkView(question, desk.mark_choice(question), chosen)


def _check(id: str, response: object) -> object:
    desk = _desk()
    question = desk.course.question(id)
    if question.name is None:
        if response is not MISSING:
            return _respond(id, response)
        chosen = desk.entry(question).get("response")
        return MarkView(question, desk.mark_choice(question, count=False), chosen)
    if response is MISSING:
        sentence = _("Give your response too: {call}.")
        raise UsageError(sentence.format(call=f'check("{id}", {question.name})'))
    if desk.was_typed(question, response):
        response = ...  # the field gave it to the variable: the field still holds the answer
    mark = desk.mark_value(question, response)
    view = MarkView(question, mark, desk.entry(question).get("response"))
    return _shown(view, lambda: kind_of(question).widget(desk, question, response, mark))


def _hint(id: str) -> object:
    desk = _desk()
    question = desk.course.question(id)
    return HintView(question, desk.open_hint(question) if question.hints else 0)


def _me(name: object) -> object:
    course = _course_at(course_of_notebook())
    if name is not MISSING:
        print(become(course, name))
        return None
    desk = _desk()

    def widget() -> Shown:
        from autograder.student.widgets.identity import IdentityWidget

        return IdentityWidget(desk)

    return _shown(IdentityView(desk.student), widget)


def _numbers(story: str) -> tuple[int | float, ...]:
    given = _desk().course.story(story)
    return namedtuple("Numbers", given)(**given)


def _predict(id: str, value: object) -> object:
    desk = _desk()
    prediction = desk.course.prediction(id)
    if value is not MISSING:
        before = desk.prediction(prediction)
        standing = desk.predict(prediction, value)
        if before is not None and prediction.read(value) != standing:
            sentence = _("You predicted {value} before; that stands.")
            print(sentence.format(value=prediction.in_words(standing)))

    def widget() -> Shown:
        from autograder.student.widgets.prediction import PredictionWidget

        return PredictionWidget(desk, prediction)

    return _shown(PredictionView(prediction, desk.prediction(prediction)), widget)


def _practise() -> object:
    from autograder.student.practice.round import Practice, summary

    desk = _desk()
    practice = Practice(desk)

    def widget() -> Shown:
        from autograder.student.widgets.practice import PracticeWidget

        return PracticeWidget(desk, practice)

    return _shown(PracticeView(summary(practice.placed())), widget)


def _progress() -> object:
    desk = _desk()

    def widget() -> Shown:
        from autograder.student.widgets.progress import ProgressWidget

        return ProgressWidget(desk)

    return _shown(ProgressView(desk.course, desk.entries()), widget)


def _submit(to: Path | None) -> object:
    desk = _desk()
    view = pack_and_say(desk, to)

    def widget() -> Shown:
        from autograder.student.widgets.submission import SubmissionWidget

        return SubmissionWidget(desk, view, lambda: pack_and_say(desk, to))

    return _shown(view, widget)
