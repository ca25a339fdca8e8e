"""Relations between a number that was given and the right one, in order of simplicity."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[np.float64]


@dataclass(frozen=True)
class Relation:
    """``change`` makes of what is right what was given; ``sentence`` says what that looks like."""

    name: str
    sentence: str
    change: Callable[[Numbers], Numbers]

    def and_then(self, other: Relation) -> Diagnosis:
        """The name of two relations, one after the other."""
        second = other.sentence.removeprefix("It looks as if ")
        return Diagnosis(
            f"{self.name}, then {other.name}",
            f"It looks as if there are two things: {self.sentence[len('It looks as if ') : -1]}; "
            f"and {second}",
        )


@dataclass(frozen=True)
class Diagnosis:
    """The name of what went wrong, and a sentence on it for the student.

    ``evidence`` says to the instructor what it was found by. It may quote the key, so it stays with
    those who have the key.
    """

    name: str
    sentence: str
    evidence: str = ""


# Of each: the name, what the sentence says after "It looks as if", and the change.
RELATIONS = tuple(
    Relation(name, f"It looks as if {sentence}.", change)
    for name, sentence, change in (
        (
            "sign turned",
            "the sign is turned round; try it on an example that is small enough to do by hand",
            lambda x: -x,
        ),
        ("without its sign", "the sign was dropped; a value may be negative here", np.abs),
        ("twice", "a factor 2 is counted twice or not divided out", lambda x: 2 * x),
        ("half", "a factor 2 was lost", lambda x: x / 2),
        ("degrees", "an angle is in degrees; radians are asked for", np.degrees),
        ("radians", "an angle was converted to radians that already was in radians", np.radians),
        ("in percent", "it is in percent; give the fraction itself", lambda x: 100 * x),
        ("a hundredth", "it was divided by a hundred", lambda x: x / 100),
        ("complement", "it is the opposite case; take the complement", lambda x: 1 - x),
        ("reciprocal", "the fraction is upside down", lambda x: 1 / x),
        ("one more", "the count begins or ends one too late", lambda x: x + 1),
        ("one less", "the count begins or ends one too early", lambda x: x - 1),
        ("squared", "a square was left in place; is its root asked for?", np.square),
        ("its root", "a root was taken that is not asked for", np.sqrt),
        ("its logarithm", "a logarithm was taken that is not asked for", np.log),
        (
            "common logarithm",
            "a common logarithm stands for a natural one",
            lambda x: x / np.log(10),
        ),
        (
            "binary logarithm",
            "a binary logarithm stands for a natural one",
            lambda x: x / np.log(2),
        ),
        ("rounded", "it was rounded too early", np.round),
        ("rounded down", "the decimals were cut off", np.floor),
        ("rounded up", "it was rounded up", np.ceil),
    )
)
