"""Whose a submission is: a person of the class list if that is certain, and otherwise nobody.

A login, an e-mail address, an id or a participant number settles it; a name does where only one
person and only one submission has it. What fits two people, or none, is never guessed: the match
says so and gives the line for ``students.toml`` that settles it.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from autograder.intake.download_names import claim_of
from autograder.intake.find_person import Fits, People
from autograder.intake.origin import Origin
from autograder.intake.person import Person
from autograder.intake.students_toml import quoted


@dataclass(frozen=True)
class Match:
    """Whose one submission is.

    ``people`` is empty unless it is certain; several handed in together. ``candidates`` are those
    whom it may belong to, ``reason`` says why nobody was taken, and ``line`` is what to write into
    ``students.toml``.
    """

    people: tuple[Person, ...] = ()
    candidates: tuple[Person, ...] = ()
    reason: str = ""
    line: str = ""

    @property
    def person(self) -> Person | None:
        """The person, the first of a group, or None."""
        return self.people[0] if self.people else None


def match_all(
    people: Sequence[Person],
    origins: Mapping[str, Origin],
    settled: Mapping[str, str] | None = None,
) -> dict[str, Match]:
    """Whose each submission is, by the student's key.

    ``settled`` is what ``students.toml`` says: a prefix or key of a submission, and a login, an
    e-mail address, an id or a unique name of a person (several with commas, for a group).
    """
    index = People(people)
    said = {key.casefold(): value for key, value in (settled or {}).items()}
    found: dict[str, list[Fits]] = {}
    for key, origin in origins.items():
        called = [name for name in (origin.prefix, key) if name.casefold() in said]
        if called:
            found[key] = index.settle(said[called[0].casefold()])
        else:
            found[key] = [fits for claim in origin.claims for fits in index.find_all(claim)]
            found[key] = found[key] or [index.find(claim_of(key))]
    claimed: dict[Person, dict[str, int]] = defaultdict(dict)
    for key, entries in found.items():
        for entry in entries:
            if len(entry.people) == 1:
                claimed[entry.people[0]][key] = entry.strength
    return {key: _conclude(key, origins[key], entries, claimed) for key, entries in found.items()}


def _conclude(
    key: str, origin: Origin, entries: list[Fits], claimed: Mapping[Person, Mapping[str, int]]
) -> Match:
    certain: list[Person] = []
    candidates: list[Person] = []
    reasons: list[str] = []
    for entry in entries:
        candidates += entry.people or entry.likely
        if len(entry.people) != 1:
            reasons.append(entry.reason)
            continue
        person = entry.people[0]
        rivals = [
            other
            for other, strength in claimed[person].items()
            if other != key and strength >= entry.strength
        ]
        if rivals:
            other = ", ".join(repr(rival) for rival in rivals[:3])
            reasons.append(f"it fits {person.text()}, and so does {other}")
        elif person not in certain:
            certain.append(person)
    if not reasons and certain:
        return Match(tuple(certain))
    likely = candidates[0].identifiers() if candidates else ()
    value = likely[0] if likely else "LOGIN, E-MAIL ADDRESS OR ID"
    reason = "; ".join(dict.fromkeys(filter(None, reasons)))
    line = f"{quoted(origin.prefix or key)} = {quoted(value)}"
    return Match((), tuple(dict.fromkeys(candidates)), reason, line)
