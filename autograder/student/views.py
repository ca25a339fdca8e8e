"""How questions, marks and progress look in a notebook: Markdown, with plain text beside it."""

from __future__ import annotations

from autograder.course import Course
from autograder.course.predictions import Guess, Prediction
from autograder.course.questions import Question
from autograder.kinds.mark import Mark
from autograder.kinds.registry import kind_of
from autograder.kinds.status import Status
from autograder.student.receipts import RECEIPT, receipt
from autograder.student.responses import answered, points
from autograder.student.submission import Packed


def number(value: float) -> str:
    """Points without needless zeros."""
    return f"{value:.2f}".rstrip("0").rstrip(".")


def plural(count: float, noun: str) -> str:
    """``1 point``, ``2 points``."""
    return f"{number(count)} {noun}" + ("" if count == 1 else "s")


class _View:
    """Something to show, in Markdown and in plain text, maybe with a receipt for the grader."""

    def lines(self) -> list[str]:
        """The Markdown, line by line."""
        raise NotImplementedError

    def receipt(self) -> dict[str, object] | None:
        """What the grader may read from the saved output."""
        return None

    def _repr_mimebundle_(
        self, include: object = None, exclude: object = None
    ) -> dict[str, object]:
        bundle: dict[str, object] = {
            "text/plain": repr(self),
            "text/markdown": "\n".join(self.lines()),
        }
        receipt = self.receipt()
        if receipt is not None:
            bundle[RECEIPT] = receipt
        return bundle

    def __repr__(self) -> str:
        text = "\n".join(self.lines()).replace("**", "")
        text = text.replace("<details><summary>Explanation</summary>\n", "Explanation:")
        return text.replace("\n\n</details>", "")


class QuestionView(_View):
    """A question with its prompt, statements or cards, and the response so far."""

    def __init__(self, question: Question, response: object = None, foot: str = "") -> None:
        self.question = question
        self.response = response
        self.foot = foot

    def lines(self) -> list[str]:
        question = self.question
        lines = [
            f"**{question.id} · {question.title}** · {plural(question.points, 'point')}",
            "",
            question.prompt,
            "",
        ]
        lines += kind_of(question).lines(question, self.response)
        return [*lines, "", self.foot] if self.foot else lines

    def receipt(self) -> dict[str, object] | None:
        if self.response is None:
            return None
        return receipt(self.question.id, self.response)


class IdentityView(_View):
    """Who the student has said they are."""

    def __init__(self, student: str) -> None:
        self.student = student

    def lines(self) -> list[str]:
        call = '`me("Ada Lovelace")`'
        if self.student:
            return [f"You are **{self.student}**. To be somebody else, run {call} with that name."]
        return [f"You have not said who you are. To say it, run {call} with your own name."]


class PredictionView(_View):
    """Something to predict, and what was predicted."""

    def __init__(self, prediction: Prediction, value: Guess | None) -> None:
        self.prediction = prediction
        self.value = value

    def lines(self) -> list[str]:
        prediction = self.prediction
        lines = [f"**{prediction.id} · Predict**", "", prediction.prompt, ""]
        if self.value is not None:
            return [*lines, f"You predicted: {prediction.in_words(self.value)}"]
        lines += [f"{n}. {text}" for n, text in enumerate(prediction.choices, 1)]
        example = "1" if prediction.choices else "NUMBER"
        call = f'`predict("{prediction.id}", {example})`'
        return [*lines, *[""] * bool(prediction.choices), f"Not predicted. To predict, run {call}."]

    def receipt(self) -> dict[str, object] | None:
        return None if self.value is None else receipt(self.prediction.id, self.value)


class MarkView(_View):
    """A mark with its feedback; the explanation is folded away."""

    def __init__(self, question: Question, mark: Mark, response: object) -> None:
        self.question = question
        self.mark = mark
        self.response = response

    def lines(self) -> list[str]:
        mark = self.mark
        sign = Status(mark.status).sign
        earned = (
            ""
            if mark.status == "recorded"
            else f" · {number(mark.points)} of {plural(mark.max_points, 'point')}"
        )
        lines = [f"**{sign} {mark.question} {mark.status}**{earned}", "", mark.feedback]
        wrong = [part for part in mark.parts if part.feedback and part.right is not True]
        if kind_of(self.question).parts_stand_alone:
            lines += ["", *(f"- {part.label}: {part.feedback}" for part in wrong)] if wrong else []
        if mark.full_explanation and mark.status in ("right", "partial", "wrong"):
            lines += [
                "",
                "<details><summary>Explanation</summary>",
                "",
                mark.full_explanation,
                "",
                "</details>",
            ]
        return lines

    def receipt(self) -> dict[str, object] | None:
        if self.response is None:
            return None
        return receipt(self.question.id, self.response)


class ProgressView(_View):
    """Points so far, chapter by chapter."""

    def __init__(self, course: Course, entries: dict[str, dict[str, dict[str, object]]]) -> None:
        self.course = course
        self.entries = entries

    def lines(self) -> list[str]:
        lines = ["| chapter | answered | points |", "|:--|--:|--:|"]
        total, most = 0.0, 0.0
        for chapter in self.course.chapters:
            entries = self.entries[chapter.name]
            earned = sum(points(entries.get(question.id)) for question in chapter.questions)
            possible = sum(question.points for question in chapter.questions)
            count = sum(answered(entries.get(question.id)) for question in chapter.questions)
            lines.append(
                f"| {chapter.title} | {count} of {len(chapter.questions)} "
                f"| {number(earned)} of {number(possible)} |"
            )
            total, most = total + earned, most + possible
        return [*lines, f"| **together** | | **{number(total)} of {number(most)}** |"]

    def __repr__(self) -> str:
        rows = [line.strip("| ").replace("**", "").split("|") for line in self.lines()]
        cells = [[cell.strip() for cell in row] for row in rows if not row[0].startswith(":")]
        return "\n".join(f"{row[0]:<24}{row[1]:>10}{row[2]:>14}" for row in cells)


class SubmissionView(_View):
    """What was packed, what is unanswered, and above all what the file may lack.

    ``warning`` says what is not saved, ``advice`` what else to do with the file.
    """

    def __init__(
        self,
        packed: Packed,
        unanswered: list[Question],
        count: int,
        warning: str = "",
        advice: str = "",
    ) -> None:
        self.packed = packed
        self.unanswered = unanswered
        self.count = count
        self.warning = warning
        self.advice = advice

    def lines(self) -> list[str]:
        notebooks = [name for name in self.packed.names if name.endswith(".ipynb")]
        held = (
            f"**{self.packed.path.name}** holds {plural(len(notebooks), 'notebook')} "
            f"({', '.join(notebooks)}) and your responses, as last saved."
        )
        if self.warning:
            lines = [f"**Not ready to hand in:** {self.warning}", "", held, ""]
        else:
            lines = [f"{held} Hand in this file.", ""]
        if self.advice:
            lines += [self.advice, ""]
        if not self.unanswered:
            return [*lines, f"All {self.count} questions are answered."]
        ids = ", ".join(question.id for question in self.unanswered)
        return [
            *lines,
            f"Unanswered or not checked: {len(self.unanswered)} of {self.count} ({ids}). "
            "You can still answer them and call `submit()` again.",
        ]
