"""The protocol: all that the engine asks of a kind of question.

Most kinds are either a `autograder.questions.choice_kinds.ChoiceKind`, whose responses are data
that a student clicks, or a `autograder.questions.code_kinds.CodeKind`, whose responses a notebook's
variable or function holds; these two say what such kinds have in common.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, ClassVar, Generic, TypeVar

import numpy as np

from autograder.exchange.messages import Message, Value
from autograder.language import N_
from autograder.mutants.mutant import Trial
from autograder.questions.answer import Alternative, Answer
from autograder.questions.drawn import Drawn
from autograder.questions.exercise import Exercise
from autograder.questions.functions_to_read import Reading
from autograder.questions.mark import Mark
from autograder.questions.question import Question

Q = TypeVar("Q", bound=Question)
A = TypeVar("A", bound=Answer)


class Kind(ABC, Generic[Q, A]):
    """One kind of question, from what an author writes to what a class page says.

    It holds no state: one object serves all questions of its kind. ``name`` is what authors write
    as ``kind``, and the name of the folder.
    """

    name: ClassVar[str]
    # The tables that an author writes, by whose fields they are read.
    question_type: ClassVar[type[Question]]
    answer_type: ClassVar[type[Answer]]
    # The module whose ``evaluate(response, probe)`` runs beside a student's code; without one it is
    # ``autograder.kinds.NAME.inside.evaluate``.
    inside: ClassVar[str] = ""
    # The fields of its key that are formulas of a question's variables, where it has any.
    formulas: ClassVar[tuple[str, ...]] = ()
    # Whether variables change nothing in its key, but its words, as those of an example worked by
    # hand, and with which set of hidden inputs it is marked.
    varies_in_words: ClassVar[bool] = False
    # The list in its question of which ``draws`` may choose, and the list in its key beside it.
    drawn_fields: ClassVar[tuple[str, str]] = ("", "")
    # Whether each part of a response is a small question of its own, with its own feedback, so that
    # what is wrong is told by the part and not by the alternative that matched.
    parts_stand_alone: ClassVar[bool] = False
    parts_heading: ClassVar[str] = N_("Parts")  # above the parts on the page of feedback
    by_hand: ClassVar[bool] = False  # whether only a person can mark it, and marks are "recorded"
    # How many right responses in other clothes prove the key, where a course has any.
    fewest_variants: ClassVar[int] = 0
    has_field: ClassVar[bool] = False  # whether a response may be typed into a field
    # Whether it is practised by reading, which of some responses is right, and not by variants.
    can_be_read: ClassVar[bool] = False
    # Whether a chapter's notebook shows the hints below the prompt, and not only who asks for them.
    hints_in_heading: ClassVar[bool] = False

    # -- asked, and right ------------------------------------------------------------------------

    def check_answer(self, question: Q, answer: A) -> None:
        """Whether a key fits its question, beyond what the types of its fields say.

        Raises:
            ValueError: if not; its text is the problem alone.
        """

    # -- understood ------------------------------------------------------------------------------

    @abstractmethod
    def fits(self, question: Q, response: object) -> bool:
        """Whether something stored, by anybody, is a response that this question can have."""

    def is_untouched(self, question: Q, response: object) -> bool:
        """Whether a response that fits is still what everybody begins with."""
        return False

    def read_response(self, question: Q, response: object) -> object:
        """A response given to ``ask(...).respond(...)``, in the form in which it is kept.

        Raises:
            UsageError: if it does not fit the question; the sentence says what would.
        """
        return response

    def in_words(self, question: Q, response: object) -> str:
        """A kept response for people to read, in one line."""
        return str(response)

    def read_typed(
        self, question: Q, text: str, variables: Mapping[str, object]
    ) -> tuple[object, object]:
        """What a text in the question's field means, and what of it is kept.

        Args:
            question: one of a kind that has a field.
            text: as typed.
            variables: those of the notebook, which a formula may use.

        Raises:
            UsageError: if it is not understood; the sentence says at which point.
        """
        raise NotImplementedError

    def typed_value(self, question: Q, response: object) -> object:
        """The value of a response that was typed and kept, ``...`` where there is none."""
        return ...

    def typed_cell(self, question: Q, response: object) -> str | None:
        """A cell that gives a kept response to the question's variable; None if nothing was typed.

        It is to be run after all others, and leaves a value alone that the notebook itself assigns.
        """
        return None

    # -- marked ----------------------------------------------------------------------------------

    def draw(self, question: Q, answer: A, rng: np.random.Generator, root: Path) -> Drawn:
        """Draw what is to be found out about a response, and what to expect of it.

        Args:
            question: what is asked.
            answer: its key.
            rng: the same draws give the same probe.
            root: the course's, whose code a key may name.

        Raises:
            CourseError: if the key names something that is not there.
        """
        return Drawn(self.base_probe())

    def base_probe(self) -> dict[str, object]:
        """What every probe of this kind holds: who evaluates it."""
        return {"kind": self.name, **({"inside": self.inside} if self.inside else {})}

    @abstractmethod
    def mark(
        self, question: Q, answer: A, drawn: Drawn, response: object, understood: str = ""
    ) -> Mark:
        """Mark a response: what is kept (None for nothing), or what came back for the probe.

        Nothing in it is trusted. ``understood`` is what it looked like before anything hidden was
        sent to the process that holds it.
        """

    def example(self, drawn: Drawn) -> tuple[Message, Value] | None:
        """An input that students may see, with its right result, to draw beside theirs."""
        return None

    def picture(self, answer: A) -> str | None:
        """The dotted name of the function that describes such a drawing, if the key names one."""
        return None

    def remark(self, question: Q, response: dict[str, object]) -> str:
        """What the question alone says of a response that is only recorded: no key is needed.

        ``response`` is what came back for the probe.
        """
        return ""

    def public_cases(self, drawn: Drawn) -> list[int]:
        """Which of the probe's cases students may see, by their places."""
        return []

    # -- shown -----------------------------------------------------------------------------------

    @abstractmethod
    def lines(self, question: Q, response: object) -> list[str]:
        """The question as Markdown, below its prompt, for where no widget can be drawn."""

    def respond_line(self, question: Q, response: object) -> str:
        """A line of code that answers the question, to copy where no widget can be drawn."""
        return f'ask("{question.id}").respond(...)'

    @abstractmethod
    def widget(self, desk: Any, question: Q, value: object = ..., mark: Mark | None = None) -> Any:
        """A `QuestionWidget` that asks the question.

        ``value`` and ``mark`` are of a value that the notebook gave, if it gave one.
        """

    def read_as(self, question: Q, mark: Mark) -> list[str] | None:
        """How a marked response was read, as lines of Markdown; None: as one text."""
        return None

    def right_in_words(self, question: Q, answer: A) -> list[str]:
        """What is right, for instructors to read, a line each."""
        return [answer.code] if answer.code else []

    def known_mistakes(self, question: Q, mark: Mark, drawn: Sequence[int] = ()) -> list[str]:
        """What is wrong in a marked response, by names that the key gives.

        ``drawn`` are the numbers of the entries that the student's question has, from 1, where it
        draws some out of a bank.
        """
        return [mark.alternative] if mark.alternative is not None else []

    def other_mistakes(self, question: Q, mark: Mark) -> list[str]:
        """What is wrong in a marked response where no name is known, told by where it fails."""
        if len(mark.parts) > 1 and not any(part.right for part in mark.parts):
            return [f"wrong on all {self.parts_heading.lower()}"]
        return [f"wrong on: {part.label}" for part in mark.parts if part.right is False]

    # -- written and proven ----------------------------------------------------------------------

    @abstractmethod
    def exercise(self, question: Q, answer: A, root: Path) -> Exercise:
        """The cells of the question in a chapter's notebook.

        Raises:
            CourseError: if the key does not say how it is solved.
        """

    def problems(self, question: Q, answer: A) -> Iterator[str]:
        """What is wrong with a key that can be read, beyond what marking would show."""
        yield from ()

    def unsound(self, question: Q, answer: A, drawn: Drawn, root: Path) -> Iterator[str]:
        """What is wrong with what was drawn, though no mark would show it."""
        yield from ()

    def response_like(self, question: Q, alternative: Alternative, drawn: Drawn) -> object:
        """A response that is this alternative, as `mark` takes it; None if there is none."""
        return None

    def poor_draw(self, question: Q, answer: A) -> Iterator[str]:
        """Why what was drawn for a variant is a poor choice, if it is."""
        yield from ()

    def poor_value(self, question: Q, value: float, sheets: float) -> Iterator[str]:
        """Why a variant's right value is a poor one beside the sheet's, if it is."""
        yield from ()

    # -- kept back, and handed out ---------------------------------------------------------------

    def secrets(self, question: Q, answer: A) -> Iterator[str]:
        """The texts of a key that no student may read."""
        yield answer.explanation
        yield answer.code
        for alternative in answer.alternatives:
            if not alternative.in_bundle:
                yield alternative.feedback

    def right_texts(self, answer: A) -> tuple[str, ...]:
        """What a student could type to earn everything, where that is a text."""
        return (answer.code,) if answer.code else ()

    def secret_numbers(self, question: Q, answer: A) -> Iterator[str]:
        """The right values of a key, as a student would see them printed."""
        yield from ()

    def code_names(self, answer: A) -> tuple[str, ...]:
        """The dotted names of the course's own code that marking with this key needs."""
        return ()

    def solutions(self, answer: A) -> tuple[str, ...]:
        """Those of them that are a solution, right or wrong; the right one stands first."""
        return ()

    def trial(
        self,
        question: Q,
        answer: A,
        proven: Sequence[str],
        root: Path,
        draw: Callable[[int], np.random.Generator],
    ) -> Trial | None:
        """The mutants of what is right; None for a kind whose key has nothing to change.

        Args:
            question: what is asked.
            answer: its key.
            proven: the references of all questions; each is changed for its own question only.
            root: the course's.
            draw: the random numbers of a seed, as for `draw`.
        """
        return None

    def variant(self, question: Q, written: object) -> Value:
        """The response that an entry of ``solutions/variants`` stands for.

        It was written by the course's author: a function, or a text as a student types it.
        """
        return written

    def reading(
        self,
        question: Q,
        answer: A,
        drawn: Drawn,
        rng: np.random.Generator,
        root: Path,
        names: Sequence[str],
    ) -> Reading | None:
        """Functions to read for practice; None where there is nothing short enough.

        Args:
            question: what is asked.
            answer: its key.
            drawn: as for `mark`.
            rng: the same draws give the same reading.
            root: the course's.
            names: what the questions of the course define, which a reader knows.
        """
        return None

    def promises(self, answer: A, root: Path, drawn: Drawn) -> list[tuple[str, list[str]]]:
        """What a prompt promises to raise, and the names of the cases that test it."""
        return []

    def take_snapshot(
        self, question: Q, answer: A, drawn: Drawn, again: Drawn
    ) -> tuple[Message, list[str]] | None:
        """What a student bundle checks with, as plain data, and the mistakes it cannot tell.

        ``drawn`` was drawn for this alone, so that its inputs grade nobody, and ``again`` another:
        what is the same in both is the same in those that grade. None for a kind whose responses
        are only recorded there.
        """
        return None

    def snapshot_probe(self, question: Q, snapshot: dict[str, object] | None) -> dict[str, object]:
        """The probe that goes with a snapshot, or with none."""
        return self.base_probe()

    def mark_snapshot(
        self, question: Q, snapshot: dict[str, object], response: dict[str, object]
    ) -> Mark:
        """Mark what came back for the probe of a snapshot."""
        raise NotImplementedError
