"""The verdict on one response."""

from __future__ import annotations

from dataclasses import asdict, dataclass

import msgspec

from autograder.exchange.messages import Value
from autograder.language import N_, _
from autograder.questions.question import Question
from autograder.questions.status import Status

STATUSES = tuple(str(status) for status in Status)

# Said once of a question, whatever came and on however many hidden inputs: which exception it was,
# and where, could carry a hidden input to the page of feedback.
NO_VALUE = N_(
    "On at least one of these it gives nothing that can be compared: it raises an exception, "
    "changes its input, or returns something of another kind."
)


@dataclass(frozen=True)
class Part:
    """The verdict on one statement, card or kind of input; ``right`` is None if nothing was said.

    ``explanation`` is as for `Mark`, about this part alone.
    """

    label: str
    right: bool | None
    feedback: str
    explanation: str = ""


@dataclass(frozen=True)
class Mark:
    """The verdict on one response.

    ``credit`` runs from 0 to 1; ``alternative`` names the recognised response or mistake.
    ``feedback`` says what to do next and never contains a hidden input; ``explanation`` gives the
    answer away and is shown only where the key is at hand or the instructor allows it. ``shown``
    is what a function returned for a public input, as JSON data, for the picture in the feedback.
    ``told`` is the exception that the student's code raised where nothing hidden had been sent yet,
    with its line, and ``code`` the cell that holds the response; both are the student's own words.
    ``evidence`` says to the instructor by what a wrong response got its name; it may quote the key
    and is shown to no student.
    """

    question: str
    status: str
    credit: float
    max_points: float
    feedback: str
    alternative: str | None = None
    parts: tuple[Part, ...] = ()
    explanation: str = ""
    understood: str = ""
    shown: Value = None
    told: str = ""
    code: str = ""
    evidence: str = ""

    def __post_init__(self) -> None:
        if self.status not in STATUSES:
            raise ValueError(f"{self.status!r} is not a status of a mark")
        if not 0 <= self.credit <= 1:
            raise ValueError(f"credit {self.credit} is not between 0 and 1")

    @property
    def points(self) -> float:
        """What the response earns, to two decimals."""
        return round(self.credit * self.max_points, 2)

    @property
    def full_explanation(self) -> str:
        """The explanations of the parts and of the whole, as Markdown."""
        parts = [f"- {part.label}: {part.explanation}" for part in self.parts if part.explanation]
        return "\n\n".join(filter(None, ["\n".join(parts), self.explanation]))

    def to_dict(self) -> dict[str, object]:
        """Plain data, for the wire and the gradebook."""
        return asdict(self)

    @classmethod
    def from_dict(cls, fields: dict[str, object]) -> Mark:
        """The mark that `to_dict` wrote.

        Raises:
            ValueError: if it is anything else; what a newer version wrote besides is left out.
        """
        return msgspec.convert(fields, cls)


def status_for(credit: float) -> str:
    """``right`` for full credit, ``wrong`` for none, ``partial`` between."""
    return "right" if credit == 1 else "partial" if credit > 0 else "wrong"


def not_attempted(question: Question, feedback: str = "") -> Mark:
    """The mark of an untouched question."""
    feedback = feedback or _("Nothing was answered yet.")
    return Mark(question.id, "not attempted", 0.0, question.points, feedback)


_STOPPED = {
    "error": N_("Running it raised an exception."),
    "timeout": N_("It took longer than the time limit; look for a loop that never ends."),
    "killed": N_("The process that ran it ended: too much memory, a crash, or an exit."),
    "unreadable": N_("The submission could not be opened."),
    "recorded": N_("Recorded. It will be marked after you hand in."),
}


def stopped(question: Question, status: str, feedback: str = "") -> Mark:
    """The mark of a question that could not be marked, with its reason."""
    return Mark(question.id, status, 0.0, question.points, feedback or _(_STOPPED[status]))
