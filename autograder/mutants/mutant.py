"""One change of what is right, and what is needed to find out whether marking notices it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Mutant:
    """A change: ``name`` says it in one line, by which a declaration refers to it.

    ``operator`` is the kind of change in words, ``line`` the number of the changed line in its
    file (0: none), ``diff`` the change as a reader of diffs knows it.
    """

    name: str
    operator: str
    diff: str
    line: int = 0


class OutOfTime(BaseException):
    """A mutant took too long. No ``except Exception`` of the course's code catches this."""


class Trial(ABC):
    """The mutants of one question's right response, ready to be marked."""

    mutants: Sequence[Mutant]

    @abstractmethod
    def passes(self, index: int, seed: int) -> bool:
        """Whether a mutant earns everything, with the hidden inputs of a seed."""

    @abstractmethod
    def cases(self, seed: int) -> Sequence[str]:
        """What a mutant that earns everything has passed, in words."""
