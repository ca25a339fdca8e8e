"""What every question has, whatever its kind. Nothing here knows an answer."""

from __future__ import annotations

from typing import Annotated, ClassVar

from msgspec import Meta, field

from autograder.questions.author_tables import ID, FieldError, Points, Text, Written
from autograder.questions.variables import Number, Steps


class Question(Written, frozen=True, kw_only=True, tag_field="kind"):
    """One thing asked, as ``notebooks/questions/CHAPTER.toml`` has it.

    ``id`` is stable (``Q3.2.1``), ``prompt`` and ``hints`` are Markdown. ``kind`` is the name of
    the kind's folder. ``chapter`` is the file's name, and no author writes it.
    """

    kind: ClassVar[str]

    id: Annotated[str, Meta(pattern=ID, description="a stable name, such as Q3.2.1")]
    chapter: str = ""
    title: Text
    prompt: Annotated[Text, Meta(description="what is asked, in Markdown")]
    hints: Annotated[
        tuple[Text, ...], Meta(min_length=1, description="each a little more than the one before")
    ]
    story: Annotated[str, Meta(description="the story of the chapter whose numbers it has")] = ""
    variables: Annotated[
        dict[str, tuple[Number, ...] | Steps], Meta(description="numbers of its own that vary")
    ] = field(default_factory=dict)

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.story and self.variables:
            raise FieldError(
                "it has the numbers of a story; remove story or variables", "variables"
            )

    @property
    def points(self) -> float:
        """What a right response earns; 0 if it is there for practice only."""
        raise NotImplementedError(f"{type(self).__name__} says nothing of points")

    @property
    def name(self) -> str | None:
        """The variable or function that holds the response, or None if it is given to ``ask``."""
        return None


class PointedQuestion(Question, frozen=True, kw_only=True):
    """A question whose author says what it is worth."""

    points: Points
