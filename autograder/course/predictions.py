"""What students predict before a picture shows it: kept, counted for the class, never marked.

A ``[[prediction]]`` table stands in the file of a chapter's questions. Nobody writes down what
comes true: the picture after it shows that.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, TypeGuard

import msgspec
import numpy as np
from msgspec import Meta

from autograder.course.placeholders import fill_text
from autograder.errors import UsageError
from autograder.language import _
from autograder.questions.author_tables import FieldError, Text, Written

ID = r"^P\d+(\.\d+)*[a-z]?$"
MOST_DIGITS = 6  # of a number in words

Guess = str | int | float


class Prediction(Written, frozen=True, kw_only=True):
    """One choice out of some, or a number between two others.

    What is kept of a choice is its text, so that another order of them changes nobody's.
    """

    id: Annotated[str, Meta(pattern=ID, description="a stable name, such as P3.1")]
    chapter: str = ""
    prompt: Annotated[Text, Meta(description="what to predict, in Markdown")]
    choices: Annotated[tuple[Text, ...], Meta(description="what to choose from")] = ()
    between: Annotated[
        tuple[float, float] | None, Meta(description="the least and the largest number")
    ] = None
    integer: bool = False
    unit: str = ""
    unit_of_one: Annotated[str, Meta(description="the unit after 1, if it differs")] = ""
    story: Annotated[str, Meta(description="the story whose numbers its prompt holds")] = ""

    def __post_init__(self) -> None:
        super().__post_init__()
        if bool(self.choices) == (self.between is not None):
            raise FieldError("say either choices = [...] or between = [least, largest]", "between")
        if self.choices and (len(self.choices) < 2 or len(set(self.choices)) < len(self.choices)):
            raise FieldError("give two different choices or more", "choices")
        if self.choices and (self.unit or self.unit_of_one or self.integer):
            raise FieldError("a choice has no unit and is no integer; remove them", "unit")
        if self.between is not None and not self.between[0] < self.between[1]:
            raise FieldError("the first number of between must be below the second", "between")

    def with_numbers(self, numbers: Mapping[str, int | float]) -> Prediction:
        """The same with numbers in its prompt."""
        return msgspec.structs.replace(self, prompt=fill_text(self.prompt, numbers))

    def fits(self, value: object) -> TypeGuard[Guess]:
        """Whether something stored, by anybody, can be this prediction."""
        if self.between is None:
            return isinstance(value, str) and value in self.choices
        if isinstance(value, bool) or not isinstance(value, int | float):
            return False
        low, high = self.between
        return low <= value <= high and (not self.integer or value == math.floor(value))

    def read(self, value: object) -> Guess:
        """What was given, as it is kept: a choice by its text or its number from 1, or a number.

        Raises:
            UsageError: if it cannot be this prediction; the sentence says what can.
        """
        if self.between is None:
            if isinstance(value, int) and not isinstance(value, bool):
                value = self.choices[value - 1] if 1 <= value <= len(self.choices) else None
            if self.fits(value):
                return str(value)
            listed = ", ".join(f"{n} ({text})" for n, text in enumerate(self.choices, 1))
            raise UsageError(_("Choose one of {choices}.").format(choices=listed))
        number = (
            value.item()
            if isinstance(value, np.generic | np.ndarray) and value.ndim == 0
            else value
        )  # NumPy's
        if self.fits(number):
            return int(number) if self.integer or number == int(number) else float(number)
        sentence = (
            _("Give a whole number from {low} to {high}.")
            if self.integer
            else _("Give a number from {low} to {high}.")
        )
        low, high = (f"{bound:,.{MOST_DIGITS}g}" for bound in self.between)
        raise UsageError(sentence.format(low=low, high=f"{high}{self._unit(self.between[1])}"))

    def in_words(self, value: Guess) -> str:
        """A kept prediction for people to read."""
        return value if isinstance(value, str) else f"{value:.{MOST_DIGITS}g}{self._unit(value)}"

    def _unit(self, value: float) -> str:
        unit = self.unit_of_one if value == 1 and self.unit_of_one else self.unit
        return f" {unit}" if unit else ""
