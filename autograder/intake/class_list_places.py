"""Where everybody stands in a class list, whatever they call themselves in a notebook."""

from __future__ import annotations

from collections.abc import Sequence

from autograder.intake.person import Person
from autograder.questions.variables import canonical


def seats(people: Sequence[Person]) -> tuple[dict[str, int], tuple[str, ...]]:
    """The place of each name, login and number; and the names that more than one person has."""
    found: dict[str, int] = {}
    shared: dict[str, None] = {}
    for place, person in enumerate(people):
        for name in person.names_said():
            if found.setdefault(canonical(name), place) != place:
                shared[canonical(name)] = None
    for name in shared:
        del found[name]
    return found, tuple(shared)
