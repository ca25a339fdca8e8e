"""What the widgets of all questions show: hints, attempts, the mark, and what is kept."""

from __future__ import annotations

from collections.abc import Callable

from autograder.course.questions import Question
from autograder.errors import AutograderError
from autograder.exchange.responses import Entry
from autograder.language import _, n_
from autograder.questions.mark import Mark
from autograder.questions.registry import kind_of
from autograder.questions.status import Status
from autograder.reports.markdown import inline, markdown
from autograder.student.desk import Desk, hints_open
from autograder.student.frontend import in_vscode
from autograder.student.points_in_words import points_of
from autograder.student.responses import attempts
from autograder.student.widgets.base import CourseWidget, receipt_output


class QuestionWidget(CourseWidget):
    """One question on show."""

    def __init__(self, desk: Desk, question: Question, with_prompt: bool) -> None:
        self.question = question
        self.topic = question.id
        self.mark: Mark | None = None
        self.marked_response: object = None
        self._with_prompt = with_prompt
        self._practised: CourseWidget | None = None
        self._refusal = desk.responses(question).refusal()
        super().__init__(desk)

    def what_is_fixed(self) -> dict[str, object]:
        question = self.question
        return {
            "label": f"{question.id} · {question.title}",
            "prompt": markdown(question.prompt) if self._with_prompt else "",
            "hints": [markdown(hint) for hint in question.hints],
            "marks": self.desk.can_mark(question),
            "foot": self.desk.whose(question),
            "another": self.can_have_another(),
        }

    def what_is_kept(self) -> dict[str, object]:
        entry = self.desk.entry(self.question)
        count = attempts(entry)
        return {
            "response": entry.get("response"),
            "attempts": n_("{count} attempt", "{count} attempts", count).format(count=count)
            if count
            else "",
            "hints": hints_open(entry),
            "mark": self.mark_on_show(entry),
            "refusal": self._refusal,
        }

    def mark_on_show(self, entry: Entry) -> dict[str, object] | None:
        """The mark, as long as it belongs to what is kept."""
        mark = self.mark
        if mark is None or entry.get("response") != self.marked_response:
            return None
        earned = _earned(mark) if self.desk.counts and mark.status != "recorded" else ""
        return {
            "status": mark.status,
            "said": Status(mark.status).plain,
            "sign": Status(mark.status).sign,
            "points": earned,
            "feedback": inline(mark.feedback),
            "explanation": markdown(mark.explanation) if mark.status in _EXPLAINED else "",
            "parts": [
                {
                    "right": part.right,
                    "feedback": inline(part.feedback),
                    "explanation": inline(part.explanation),
                }
                for part in mark.parts
            ],
        }

    def show_mark(self, mark: Mark) -> None:
        """Keep a mark on show with the response that it judges."""
        self.mark = mark
        self.marked_response = self.desk.entry(self.question).get("response")

    def do_hint(self, message: dict[str, object]) -> dict[str, object]:
        """Open one more hint."""
        self.desk.open_hint(self.question)
        return {}

    def can_have_another(self) -> bool:
        """Whether the question can be practised here, with other numbers or by reading."""
        if not self.desk.counts:  # this is one
            return False
        from autograder.student.practice.another import can_practise

        return can_practise(self.desk, self.question)

    def do_another(self, message: dict[str, object]) -> dict[str, object]:
        """Make a fresh variant; the reply says which widget shows it."""
        from autograder.student.practice.another import another_one

        before, self._practised = self._practised, None
        last = -1
        if before is not None:
            last = before.desk.course.variants.get(self.question.id, 0)
            before.close()
        self._practised = another_one(self.desk, self.question, unlike=last)
        return {"child": self._practised.model_id}

    def close(self) -> None:
        if self._practised is not None:
            self._practised.close()
        super().close()

    def receipt(self) -> dict[str, object] | None:
        response = self.desk.entry(self.question).get("response")
        words = _("Kept for {question}: {response}").format(
            question=self.question.id, response=self.words(response)
        )
        if in_vscode():  # where the widget may be an error: this line is there nevertheless
            line = kind_of(self.question).respond_line(self.question, response)
            sentence = _("If there is nothing to click, answer in a cell: {line}")
            words += f" {sentence.format(line=line)}"
        return receipt_output(words, self.question.id, response)

    def words(self, response: object) -> str:
        """The response for people to read."""
        return _("nothing yet.") if response is None else str(response)

    def remark(self, mark: Callable[[], Mark]) -> None:
        """Run ``mark`` and show its result; a broken key is no reason not to show the question."""
        try:
            self.show_mark(mark())
        except AutograderError:
            self.mark = None


_EXPLAINED = ("right", "partial", "wrong")


def _earned(mark: Mark) -> str:
    return points_of(mark.points, mark.max_points)
