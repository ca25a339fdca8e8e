"""Relations between a number that was given and the right one, in order of simplicity."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from autograder.language import N_, _

Numbers = NDArray[np.float64]


def looks_as_if(words: str) -> str:
    """The sentence of a diagnosis; ``words`` say it in the language that is spoken."""
    return _("It looks as if {words}.").format(words=words)


def another_answer(id: str, title: str) -> str:
    """The sentence to a response that answers another question."""
    sentence = _(
        "It looks as if this is the answer to {question}, {title}; what is different here?"
    )
    return sentence.format(question=id, title=repr(title))


@dataclass(frozen=True)
class Relation:
    """``change`` makes of what is right what was given; ``words`` say it in English."""

    name: str
    words: str
    change: Callable[[Numbers], Numbers]

    @property
    def diagnosis(self) -> Diagnosis:
        """Its name, and the sentence in the language that is spoken."""
        return Diagnosis(self.name, looks_as_if(_(self.words)))

    def and_then(self, other: Relation) -> Diagnosis:
        """The name of two relations, one after the other."""
        sentence = _("It looks as if there are two things: {first}; and {second}.")
        return Diagnosis(
            f"{self.name}, then {other.name}",
            sentence.format(first=_(self.words), second=_(other.words)),
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
    Relation(name, words, change)
    for name, words, change in (
        (
            "sign turned",
            N_("the sign is turned round; try it on an example small enough to do by hand"),
            lambda x: -x,
        ),
        ("without its sign", N_("the sign was dropped; a value may be negative here"), np.abs),
        ("twice", N_("a factor 2 is counted twice or not divided out"), lambda x: 2 * x),
        ("half", N_("a factor 2 was lost"), lambda x: x / 2),
        ("degrees", N_("an angle is in degrees; radians are asked for"), np.degrees),
        (
            "radians",
            N_("an angle was converted to radians that already was in radians"),
            np.radians,
        ),
        ("in percent", N_("it is in percent; give the fraction itself"), lambda x: 100 * x),
        ("a hundredth", N_("it was divided by a hundred"), lambda x: x / 100),
        ("complement", N_("it is the opposite case; take the complement"), lambda x: 1 - x),
        ("reciprocal", N_("the fraction is upside down"), lambda x: 1 / x),
        ("one more", N_("the count begins or ends one too late"), lambda x: x + 1),
        ("one less", N_("the count begins or ends one too early"), lambda x: x - 1),
        ("squared", N_("a square was left in place; perhaps its root is asked for"), np.square),
        ("its root", N_("a root was taken that is not asked for"), np.sqrt),
        ("its logarithm", N_("a logarithm was taken that is not asked for"), np.log),
        (
            "common logarithm",
            N_("a common logarithm stands for a natural one"),
            lambda x: x / np.log(10),
        ),
        (
            "binary logarithm",
            N_("a binary logarithm stands for a natural one"),
            lambda x: x / np.log(2),
        ),
        ("rounded", N_("it was rounded too early"), np.round),
        ("rounded down", N_("the decimals were cut off"), np.floor),
        ("rounded up", N_("it was rounded up"), np.ceil),
    )
)
