"""Finding one student by whatever an instructor knows: name, id, login, e-mail address or key."""

from __future__ import annotations

from collections.abc import Sequence

from autograder.errors import UsageError
from autograder.gradebook.record import Record
from autograder.intake.name_spellings import plain_name, typed_letters
from autograder.intake.person import Person


def find_record(records: Sequence[Record], said: str, missing: Sequence[Person] = ()) -> Record:
    """The record of one student; upper and lower case do not matter.

    What belongs to one student alone goes before names, and a whole name before a part of one.
    ``missing`` are those of the class list who handed in nothing.

    Raises:
        UsageError: if it fits nobody, or several; the sentence names them.
    """
    wanted = said.strip()
    for fits in (
        [r for r in records if r.student == wanted],
        [r for r in records if wanted.casefold() in _identifiers(r)],
        [r for r in records if _names(r) & _orders(wanted)],
        [r for r in records if r.student.casefold() == wanted.casefold()],
    ):
        if len(fits) == 1:
            return fits[0]
        if fits:
            raise UsageError(
                f"{said!r} fits {len(fits)} submissions: {_listed(fits)}. Give an e-mail address, "
                "a login, an id, or the submission's own name."
            )
    for person in missing:
        called = {text.casefold() for text in (*person.identifiers(), person.number)}
        if wanted.casefold() in called or _orders(person.name) & _orders(wanted):
            raise UsageError(f"{person.text()} is in the class list and handed in nothing.")
    part = typed_letters(wanted)
    near = [r for r in records if part and part in typed_letters(f"{r.name} {r.student}")]
    known = _listed(near) if near else f"{len(records)} others"
    raise UsageError(f"The gradebook has no student {said!r}; it has {known}.")


def _identifiers(record: Record) -> set[str]:
    found = {
        text for person in record.people for text in (*person.identifiers(), person.number) if text
    }
    if not record.people:
        for claim in record.origin.claims:
            found |= {claim.login, claim.email, claim.id, claim.number} - {""}
    return {text.casefold() for text in {*found, record.origin.prefix} - {""}}


def _names(record: Record) -> set[str]:
    names = {person.name for person in record.people} or {
        claim.name for claim in record.origin.claims
    }
    return {way for name in names | {record.name} for way in _orders(name)}


def _orders(name: str) -> set[str]:
    """A name as it is, and ``Lovelace, Ada`` as ``Ada Lovelace``."""
    last, _, first = name.partition(",")
    return {plain_name(name), plain_name(f"{first} {last}")} - {""}


def _listed(records: Sequence[Record]) -> str:
    named = [r.student if r.name == r.student else f"{r.name} ({r.student})" for r in records[:5]]
    return ", ".join(named) + (", ..." if len(records) > 5 else "")
