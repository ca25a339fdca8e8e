"""How questions, marks and progress look in a notebook: Markdown, with plain text beside it."""

from __future__ import annotations

from autograder.course import Course
from autograder.course.predictions import Guess, Prediction
from autograder.course.questions import Question
from autograder.language import _, n_
from autograder.questions.mark import Mark
from autograder.questions.registry import kind_of
from autograder.questions.status import Status
from autograder.student.points_in_words import in_points, number, points_of
from autograder.student.receipts import RECEIPT, receipt
from autograder.student.responses import answered, only_recorded, points
from autograder.student.submission import Packed


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
        word = _("Explanation")
        text = text.replace(f"<details><summary>{word}</summary>\n", f"{word}:")
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
            f"**{question.id} · {question.title}** · {in_points(question.points)}",
            "",
            question.prompt,
            "",
        ]
        lines += kind_of(question).lines(question, self.response)
        lines += _hint_line(question)
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
            sentence = _("You are **{name}**. To be somebody else, run {call} with that name.")
            return [sentence.format(name=self.student, call=call)]
        sentence = _("You have not said who you are. To say it, run {call} with your own name.")
        return [sentence.format(call=call)]


class PracticeView(_View):
    """What is known, where no widget can be drawn to practise in."""

    def __init__(self, summary: str) -> None:
        self.summary = summary

    def lines(self) -> list[str]:
        sentence = _("Practice needs JupyterLab or another program that shows widgets.")
        return [f"{self.summary} {sentence}"]


class PredictionView(_View):
    """Something to predict, and what was predicted."""

    def __init__(self, prediction: Prediction, value: Guess | None) -> None:
        self.prediction = prediction
        self.value = value

    def lines(self) -> list[str]:
        prediction = self.prediction
        lines = [f"**{prediction.id} · {_('Predict')}**", "", prediction.prompt, ""]
        if self.value is not None:
            sentence = _("You predicted: {value}").format(value=prediction.in_words(self.value))
            return [*lines, sentence]
        lines += [f"{n}. {text}" for n, text in enumerate(prediction.choices, 1)]
        example = "1" if prediction.choices else "NUMBER"
        call = f'`predict("{prediction.id}", {example})`'
        sentence = _("Not predicted. To predict, run {call}.").format(call=call)
        return [*lines, *[""] * bool(prediction.choices), sentence]

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
        status = Status(mark.status)
        earned = (
            "" if mark.status == "recorded" else f" · {points_of(mark.points, mark.max_points)}"
        )
        lines = [
            f"**{status.sign} {mark.question} {status.plain}**{earned}",
            "",
            mark.feedback,
        ]
        wrong = [part for part in mark.parts if part.feedback and part.right is not True]
        if kind_of(self.question).parts_stand_alone:
            lines += ["", *(f"- {part.label}: {part.feedback}" for part in wrong)] if wrong else []
        if mark.status in ("wrong", "partial", "not attempted", "error"):
            lines += _hint_line(self.question)
        if mark.full_explanation and mark.status in ("right", "partial", "wrong"):
            lines += [
                "",
                f"<details><summary>{_('Explanation')}</summary>",
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


class HintView(_View):
    """The hints of a question that are open."""

    def __init__(self, question: Question, count: int) -> None:
        self.question = question
        self.count = count

    def lines(self) -> list[str]:
        hints = self.question.hints
        if not hints:
            return [_("{question} has no hints.").format(question=self.question.id)]
        lines = []
        for place, hint in enumerate(hints[: self.count], 1):
            sentence = _("Hint {number} of {count}").format(number=place, count=len(hints))
            lines += [f"**{sentence}:** {hint}", ""]
        if self.count < len(hints):
            return [*lines, _("For the next one, run this again.")]
        return lines[:-1]


def _hint_line(question: Question) -> list[str]:
    """How to get a hint where no widget gives one and the notebook does not show them."""
    if not question.hints or kind_of(question).hints_in_heading:
        return []
    return ["", _("For a hint, run {call}.").format(call=f'`hint("{question.id}")`')]


class ProgressView(_View):
    """Points so far, chapter by chapter, and which questions are open or marked later."""

    def __init__(self, course: Course, entries: dict[str, dict[str, dict[str, object]]]) -> None:
        self.course = course
        self.entries = entries

    def lines(self) -> list[str]:
        lines = [f"| {_('chapter')} | {_('answered')} | {_('points')} |", "|:--|--:|--:|"]
        total, most = 0.0, 0.0
        for chapter in self.course.chapters:
            entries = self.entries[chapter.name]
            earned = sum(points(entries.get(question.id)) for question in chapter.questions)
            possible = sum(question.points for question in chapter.questions)
            count = sum(answered(entries.get(question.id)) for question in chapter.questions)
            lines.append(
                f"| {chapter.title} | {_some(number(count), number(len(chapter.questions)))} "
                f"| {_some(number(earned), number(possible))} |"
            )
            total, most = total + earned, most + possible
        lines.append(f"| **{_('together')}** | | **{_some(number(total), number(most))}** |")
        return [*lines, *(line for said in self.remarks() for line in ("", said))]

    def remarks(self) -> list[str]:
        """Which questions are open, and which are answered but not marked here."""
        kept = {
            question.id: self.entries[chapter.name].get(question.id)
            for chapter in self.course.chapters
            for question in chapter.questions
        }
        begun = [id for id, entry in kept.items() if answered(entry)]
        left = [id for id in kept if id not in begun]
        later = [id for id in begun if only_recorded(kept[id])]
        said = []
        if left and begun:
            said.append(_("Not answered yet: {questions}.").format(questions=", ".join(left)))
        if later:
            words = _("Answered, and marked only after you hand in: {questions}.")
            said.append(words.format(questions=", ".join(later)))
        return said

    def __repr__(self) -> str:
        table = [line for line in self.lines() if line.startswith("|")]
        rows = [line.strip("| ").replace("**", "").split("|") for line in table]
        cells = [[cell.strip() for cell in row] for row in rows if not row[0].startswith(":")]
        lines = [f"{row[0]:<24}{row[1]:>10}{row[2]:>14}" for row in cells]
        return "\n".join([*lines, *self.remarks()])


def _some(count: str, all: str) -> str:
    return _("{some} of {all}").format(some=count, all=all)


class SubmissionView(_View):
    """What was packed, what is unanswered, and above all what the file may lack.

    ``warning`` says what is not saved, ``advice`` what else to do with the file or what was done;
    ``taken`` is true if a drop folder has it already; ``nameless`` says that the name is missing.
    """

    def __init__(
        self,
        packed: Packed,
        unanswered: list[Question],
        count: int,
        warning: str = "",
        advice: str = "",
        taken: bool = False,
        nameless: str = "",
    ) -> None:
        self.packed = packed
        self.unanswered = unanswered
        self.count = count
        self.warning = warning
        self.advice = advice
        self.taken = taken
        self.nameless = nameless

    def lines(self) -> list[str]:
        notebooks = [name for name in self.packed.names if name.endswith(".ipynb")]
        held = n_(
            "**{file}** holds {count} notebook ({names}) and your responses, as last saved.",
            "**{file}** holds {count} notebooks ({names}) and your responses, as last saved.",
            len(notebooks),
        ).format(file=self.packed.path.name, count=len(notebooks), names=", ".join(notebooks))
        if self.warning:
            lines = [f"**{_('Not ready to hand in:')}** {self.warning}", "", held, ""]
        else:
            hand_in = "" if self.taken else f" {_('Hand in this file.')}"
            lines = [held + hand_in, ""]
        if self.nameless:
            lines += [self.nameless, ""]
        if self.advice:
            lines += [self.advice, ""]
        if not self.unanswered:
            return [*lines, _("All {count} questions are answered.").format(count=self.count)]
        ids = ", ".join(question.id for question in self.unanswered)
        return [
            *lines,
            _(
                "Unanswered or not checked: {count} of {all} ({questions}). "
                "You can still answer them and call `submit()` again."
            ).format(count=len(self.unanswered), all=self.count, questions=ids),
        ]
