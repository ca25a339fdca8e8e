"""A question made ready to be put: its probe, which is sent, and what stays here."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from autograder.exchange.messages import Message, Value
from autograder.questions.answer import Answer
from autograder.questions.question import Question


@dataclass(frozen=True)
class Around:
    """What stands around a question, with which a wrong response may have been mixed up.

    ``neighbors`` are the other questions of the same kind in its chapter with their keys, and
    ``numbers`` those that the chapter's notebook gives to names, such as ``w = 0.2``.
    """

    neighbors: tuple[tuple[Question, Answer], ...] = ()
    numbers: Mapping[str, float] = field(default_factory=dict)


NOTHING_AROUND = Around()


@dataclass(frozen=True)
class Drawn:
    """What was drawn for one question: ``probe`` crosses to the student, the rest never does.

    ``expected`` is whatever the question's kind needs to mark what comes back.

    ``shows_first`` says that students are shown what their function returns for the first case. The
    case is then asked in a probe of its own, `opening`, and the others later, in `rest`: student
    code can look into its callers, and would find the hidden inputs that come with the public one.

    ``tells`` says that feedback may tell what happened on hidden inputs (which exception, or why
    a value cannot be compared), as where no page of feedback goes back to whoever wrote the code.
    """

    probe: Message
    expected: Value = None
    shows_first: bool = False
    around: Around = NOTHING_AROUND
    tells: bool = True

    @property
    def opening(self) -> dict[str, object] | None:
        """The probe that is to be sent before anything hidden is, if there is such a part."""
        return {**self.probe, "cases": self.probe["cases"][:1]} if self.shows_first else None

    @property
    def rest(self) -> Message:
        """The probe that is to be sent after the opening; the whole where there is none."""
        return {**self.probe, "cases": self.probe["cases"][1:]} if self.shows_first else self.probe
