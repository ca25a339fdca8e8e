"""One person from several class lists: who is the same, and what each list knows of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields, replace

from autograder.intake.name_spellings import plain_name
from autograder.intake.person import Person


def join_people(lists: Sequence[Sequence[Person]]) -> tuple[Person, ...]:
    """The people of several lists, each once.

    One are those who share an identifier, or a name that only one person has in each list.
    """
    joined: list[Person] = []
    for people in lists:
        before = list(joined)
        for person in people:
            place = _same(person, before, people)
            if place is None:
                joined.append(person)
            else:
                index = next(n for n, known in enumerate(joined) if known is place)
                joined[index] = _merged(place, person)
                before = [joined[index] if known is place else known for known in before]
    return tuple(joined)


def _same(person: Person, before: Sequence[Person], beside: Sequence[Person]) -> Person | None:
    mine = {text.casefold() for text in person.identifiers()}
    shared = [known for known in before if mine & {text.casefold() for text in known.identifiers()}]
    if len(shared) == 1:
        return shared[0]
    if shared:
        return None
    name = plain_name(person.name)
    alike = [known for known in before if plain_name(known.name) == name]
    if len(alike) != 1 or sum(plain_name(other.name) == name for other in beside) != 1:
        return None
    (known,) = alike
    # Two values of one kind are two people.
    for key in ("login", "email", "id", "sis_id", "github", "number"):
        a, b = getattr(known, key).casefold(), getattr(person, key).casefold()
        if a and b and a != b:
            return None
    return known


def _merged(first: Person, second: Person) -> Person:
    changes = {
        field.name: getattr(second, field.name)
        for field in fields(Person)
        if not getattr(first, field.name)
    }
    return replace(first, **changes)
