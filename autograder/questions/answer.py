"""What every answer has, whatever its kind. Answers are never shipped to students."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta, field

from autograder.questions.author_tables import Credit, FieldError, Text, Written, second_of


class Alternative(Written, frozen=True, kw_only=True):
    """One recognisable response, right or wrong, with its credit from 0 to 1 and its feedback."""

    name: Text
    credit: Credit
    feedback: str = ""

    @property
    def in_bundle(self) -> bool:
        """Whether a student bundle names it, with its feedback."""
        return False

    @property
    def is_mistake(self) -> bool:
        """Whether the response is wrong, or not quite right, in a known way."""
        return self.credit < 1

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.is_mistake and not self.feedback:
            raise FieldError(f"the mistake {self.name!r} has no feedback", "feedback")


class PublicAlternative(Alternative, frozen=True, kw_only=True):
    """One whose author may let a student bundle name it."""

    public: Annotated[
        bool, Meta(description="whether a student bundle names it: its feedback tells no answer")
    ] = False

    @property
    def in_bundle(self) -> bool:
        """Whether a student bundle names it, with its feedback."""
        return self.public

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.public and not self.is_mistake:
            raise FieldError(f"{self.name!r} is right; only a mistake may be public", "public")


class Equivalent(Written, frozen=True, kw_only=True):
    """A mutant of what is right that no input can tell from it, and why."""

    mutant: Text
    why: Text


class Answer(Written, frozen=True, kw_only=True):
    """The key to one question, as ``solutions/answers/CHAPTER.toml`` has it.

    ``id`` is the question's, which the table's name says. ``code`` fills the solved notebook.
    ``snapshot`` says whether a student bundle may check it on examples. ``equivalent`` are the
    mutants that need not lose any credit.
    """

    id: str = ""
    explanation: Annotated[str, Meta(description="shown once a response was marked, Markdown")] = ""
    code: Annotated[str, Meta(description="what fills the solved notebook")] = ""
    alternatives: tuple[Alternative, ...] = field(default=(), name="alternative")
    snapshot: bool = True
    equivalent: tuple[Equivalent, ...] = ()

    def __post_init__(self) -> None:
        super().__post_init__()
        if (twice := second_of(entry.name for entry in self.alternatives)) is not None:
            raise FieldError("two alternatives have the same name", "alternative", twice, "name")
