"""One student's work in one kernel: every answer is kept first and marked then."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import replace
from typing import Any
from weakref import WeakSet

from autograder.course import Course
from autograder.course.predictions import Guess, Prediction
from autograder.course.questions import Question
from autograder.exchange.exception_text import in_words
from autograder.exchange.messages import Message, Value, Values
from autograder.exchange.replies import clean_told
from autograder.exchange.responses import Entry
from autograder.language import _
from autograder.marking.snapshots import recorded
from autograder.questions.mark import Mark, not_attempted, stopped
from autograder.questions.registry import kind_of
from autograder.sandbox.inside.evaluate import describe, evaluate
from autograder.student.frontend import running_shell
from autograder.student.marker_client import marker_for
from autograder.student.receipts import rescued_entries
from autograder.student.responses import Responses, attempts, responses_folder


class Desk:
    """Keeps and marks the responses to a course's questions.

    What is on show and must follow (widgets) is told of every change. JupyterLab handles clicks on
    a thread of its own, so that they count while a cell runs.
    """

    def __init__(self, course: Course, student: str = "") -> None:
        self.course = course
        self.student = student  # who they say they are
        self._onlookers: WeakSet[object] = WeakSet()
        self._lock = threading.Lock()
        self._searched: set[str] = set()

    counts = True  # whether marks have points

    def marker(self) -> Any:
        """What marks here; None where nothing can."""
        return marker_for(self.course)

    def variables(self) -> Values:
        """The names that a typed formula may use: the notebook's."""
        shell = running_shell()
        return shell.user_ns if shell is not None else {}

    def assign(self, question: Question, value: object) -> None:
        """Give the notebook's variable a typed value, so that the cells below can go on with it."""
        shell = running_shell()
        if shell is not None and value is not ...:
            shell.user_ns[question.name] = value

    def responses(self, question: Question) -> Responses:
        """The file that holds the responses to the question's chapter."""
        return self.chapter_responses(question.chapter)

    def chapter_responses(self, name: str) -> Responses:
        """The file that holds the responses to a chapter."""
        chapter = self.course.chapter(name)
        return Responses(
            responses_folder(self.course.root),
            name,
            rescue=lambda: rescued_entries(self.course, chapter),
        )

    def whose(self, question: Question) -> str:
        """Whose response it is, and whose numbers the question has: a sentence for its foot."""
        varies = self.course.personal and question.id in self.course.varied
        if not self.student:
            if not varies:
                return ""
            return _("These are the sheet's numbers: say who you are, and you have your own.")
        if varies:
            sentence = _("Answered by {name}, whose own numbers these are.")
        else:
            sentence = _("Answered by {name}.")
        return sentence.format(name=self.student)

    def mend(self) -> list[str]:
        """Put right what is damaged or missing, and say what was done.

        A missing file is normal for a chapter that was not begun, so it is looked into only once.
        """
        said = []
        for chapter in self.course.chapters:
            responses = self.chapter_responses(chapter.name)
            if responses.path.exists() or chapter.name not in self._searched:
                self._searched.add(chapter.name)
                said.append(responses.mend())
        return [sentence for sentence in said if sentence]

    def entries(self) -> dict[str, dict[str, Entry]]:
        """Everything that is kept, by chapter and question id."""
        return {
            chapter.name: self.chapter_responses(chapter.name).all()
            for chapter in self.course.chapters
        }

    def entry(self, question: Question) -> Entry:
        """What is kept for a question; a response that does not fit it counts as none."""
        entry = self.responses(question).get(question.id)
        response = entry.get("response")
        if response is not None and not kind_of(question).fits(question, response):
            return {**entry, "response": None}
        return entry

    def keep(self, question: Question, change: Callable[[object], object]) -> Entry:
        """Keep a response without marking it; ``change`` makes the new response of the old one.

        Raises:
            ResponsesError: if it cannot be saved.
        """

        kind = kind_of(question)

        def changed(entry: Entry) -> Entry:
            before = entry.get("response")
            response = change(before if kind.fits(question, before) else None)
            if response == before:
                return entry
            untouched = kind.is_untouched(question, response)
            status = "not attempted" if untouched else "recorded"
            return {
                **entry,
                "kind": question.kind,
                "response": response,
                "understood": "",
                "status": status,
                "points": 0.0,
                "attempts": attempts(entry),
            }

        entry = self.responses(question).update(question.id, changed)
        self.tell(question.id)
        return entry

    def prediction(self, prediction: Prediction) -> Guess | None:
        """What was predicted, None if nothing was; what does not fit counts as nothing."""
        entry = self.chapter_responses(prediction.chapter).get(prediction.id)
        value: Guess | None = entry.get("response")
        return value if prediction.fits(value) else None

    def predict(self, prediction: Prediction, value: object) -> Guess:
        """Keep a prediction, and return the one that stands: the first.

        Raises:
            UsageError: if it cannot be one; nothing is changed then.
            ResponsesError: if it cannot be saved.
        """
        chosen = prediction.read(value)

        def kept(entry: Entry) -> Entry:
            if prediction.fits(entry.get("response")):
                return entry
            return {"kind": "prediction", "response": chosen, "status": "recorded"}

        entry = self.chapter_responses(prediction.chapter).update(prediction.id, kept)
        self.tell(prediction.id)
        standing: Guess = entry["response"]
        return standing

    def mark_choice(self, question: Question, count: bool = True) -> Mark:
        """Mark the response that was clicked and kept; ``count`` it as an attempt or not.

        Raises:
            ResponsesError: if the mark cannot be saved.
            CourseError: if the key is broken; the response stays kept.
        """
        response = self.entry(question).get("response")
        if response is None or kind_of(question).is_untouched(question, response):
            mark = not_attempted(question)
        else:
            marker = self.marker()
            mark = stopped(question, "recorded")
            if marker is not None:
                mark = marker.mark(question.id, response)
        if count and response is not None:
            self.note(question, mark, lambda entry: entry.get("response"))
        return mark

    def keep_typed(self, question: Question, text: str) -> object:
        """Keep what was typed into the field of a question, and return what it means.

        Raises:
            UsageError: if it is not understood; nothing is changed then.
            ResponsesError: if it cannot be saved.
        """
        value, kept = kind_of(question).read_typed(question, text, self.variables())
        self.keep(question, lambda before: kept)
        return value

    def typed(self, question: Question) -> Value:
        """What was typed into the field of a question, ``...`` if nothing was."""
        response = self.entry(question).get("response")
        return ... if response is None else kind_of(question).typed_value(question, response)

    def was_typed(self, question: Question, response: object) -> bool:
        """Whether a variable's value is what was typed into the question's field."""
        typed = self.typed(question)
        return typed is not ... and type(response) is type(typed) and bool(response == typed)

    def mark_value(self, question: Question, response: object, count: bool = True) -> Mark:
        """Mark a value, an expression or a function.

        An ellipsis stands for what was typed into the field, if anything was.

        Raises:
            ResponsesError: if the mark cannot be saved.
            CourseError: if the key is broken.
        """
        from_field = response is ...
        if from_field:
            response = self.typed(question)
        marker = self.marker()
        understood = "" if response is ... else describe(response)
        if response is ...:
            mark = not_attempted(question)
        elif marker is not None:
            reply = evaluate(response, marker.probe(question.id))
            mark = _with_exception(marker.mark(question.id, reply, understood), reply)
        elif _is_stub(response):
            # Without a key an untouched stub is still told from a response.
            mark = not_attempted(question)
        else:
            probe = kind_of(question).snapshot_probe(question, None)
            mark = recorded(question, evaluate(response, probe))
        if count and mark.status != "not attempted":
            self.note(
                question,
                mark,
                lambda entry: entry.get("response") if from_field else None,
                understood,
            )
        return mark

    def open_hint(self, question: Question) -> int:
        """Open one more hint; returns how many are open now."""

        def opened(entry: Entry) -> Entry:
            count = min(hints_open(entry) + 1, len(question.hints))
            return {"status": "not attempted", "response": None, **entry, "hints": count}

        entry = self.responses(question).update(question.id, opened)
        self.tell(question.id)
        return hints_open(entry)

    def tell(self, id: str) -> None:
        """Let everything on show follow a change of one question."""
        for onlooker in self._present():
            onlooker.follow(id)

    def watch(self, onlooker: object) -> None:
        """Tell something on show of changes from now on, as long as it is there."""
        with self._lock:
            self._onlookers.add(onlooker)

    def unwatch(self, onlooker: object) -> None:
        """Stop telling it."""
        with self._lock:
            self._onlookers.discard(onlooker)

    def _present(self) -> list[Any]:
        with self._lock:
            return list(self._onlookers)

    def can_mark(self, question: Question) -> bool:
        """Whether a response to the question can be marked here, or only recorded."""
        marker = self.marker()
        return marker is not None and marker.can_mark(question.id)

    def note(
        self,
        question: Question,
        mark: Mark,
        response: Callable[[Entry], object],
        understood: str = "",
    ) -> None:
        """Write a mark to the response it belongs to, and count the attempt."""

        def noted(entry: Entry) -> Entry:
            return {
                **entry,
                "kind": question.kind,
                "response": response(entry),
                "understood": understood,
                "status": mark.status,
                "points": mark.points,
                "attempts": attempts(entry) + 1,
            }

        self.responses(question).update(question.id, noted)
        self.tell(question.id)


def hints_open(entry: Entry) -> int:
    """How many hints of a question have been opened."""
    count = entry.get("hints", 0)
    return count if isinstance(count, int) and count >= 0 else 0


def _with_exception(mark: Mark, reply: Message) -> Mark:
    """The mark, with the message and the line of an exception on an input that is not hidden."""
    told = in_words(clean_told(reply.get("told")))
    if not told or mark.status == "right":
        return mark
    sentence = _("The exception on an input that you can see: {told}.").format(
        told=told.rstrip(".")
    )
    return replace(mark, feedback=f"{mark.feedback} {sentence}", told=told)


def _is_stub(response: object) -> bool:
    """Whether a function still only raises NotImplementedError, as the handout's stub does."""
    code = getattr(response, "__code__", None)
    return code is not None and code.co_names == ("NotImplementedError",)
