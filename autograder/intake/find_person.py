"""The people whom a claim fits: by login, e-mail address, id or number, and else by name.

What fits two people, or none, is never guessed.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from autograder.intake.name_spellings import (
    bare_letters,
    first_name_first,
    is_anonymous,
    plain_name,
    spellings,
    typed_letters,
    without_accents,
)
from autograder.intake.origin import Claim
from autograder.intake.person import Person
from autograder.intake.students_toml import NOBODY


@dataclass(frozen=True)
class Fits:
    """The people that one claim fits, and how strongly."""

    people: tuple[Person, ...]
    strength: int
    reason: str = ""
    likely: tuple[Person, ...] = ()  # whom it may fit, though that is not known


_BY_COPY, _BY_NAME, _BY_IDENTIFIER, _SETTLED = -1, 0, 1, 2
_DOWNLOADED_AGAIN = re.compile(r"\s*\(\d{1,9}\)\Z")


class People:
    """The people by everything that they can be found by."""

    def __init__(self, people: Sequence[Person]) -> None:
        self._strong: dict[tuple[str, str], list[Person]] = defaultdict(list)
        # From the name as it is written to its bare letters, without order, accents and spaces: the
        # first that anybody has decides.
        self._names: tuple[dict[str, list[Person]], ...] = tuple(
            defaultdict(list) for _ in range(4)
        )
        self._typed: dict[str, list[Person]] = defaultdict(list)
        self._members: dict[str, list[Person]] = defaultdict(list)
        for person in dict.fromkeys(people):
            for field, kind in _KINDS:
                value = getattr(person, field).strip().casefold()
                if value and person not in self._strong[kind, value]:
                    self._strong[kind, value].append(person)
            local = person.email.partition("@")[0].casefold()
            if local and not person.login:
                self._strong["local part", local].append(person)
            for group in groups_of(person):
                self._members[group].append(person)
            ways = spellings(person.name)
            for way in {typed_letters(way) for way in ways} - {""}:
                self._typed[way].append(person)
            levels = (
                {plain_name(person.name), plain_name(first_name_first(person.name))},
                ways,
                {without_accents(way) for way in ways},
                {bare_letters(way) for way in ways},
            )
            for names, level in zip(self._names, levels, strict=True):
                for name in level - {""}:
                    names[name].append(person)

    def settle(self, value: str) -> list[Fits]:
        """The people that a line of students.toml names."""
        if value.strip().casefold() == NOBODY:
            return [Fits((), _SETTLED, "students.toml says that it is nobody's")]
        whole = self._settle_one(value)
        if len(whole.people) == 1 or "," not in value:
            return [whole]
        return [self._settle_one(part) for part in value.split(",") if part.strip()]

    def _settle_one(self, value: str) -> Fits:
        fits = self._by(value, *_IDENTIFIERS) or self._named(value)
        reason = "" if len(fits) == 1 else f"{value!r} in students.toml {_fits(fits)}"
        return Fits(fits, _SETTLED, reason)

    def find_all(self, claim: Claim) -> list[Fits]:
        """The people that a claim fits: all of a group, where Moodle names the group alone.

        That is what it does where a team hands in together: ``Group A_55``, with the number of the
        group. (mod/assign/classes/downloader.php)
        """
        if claim.number and not self._named(claim.name):
            members = self._members.get(plain_name(claim.name), [])
            if members:
                return [Fits((person,), _BY_NAME) for person in members]
        return [self.find_file(claim)]

    def find_file(self, claim: Claim) -> Fits:
        """The people that a claim fits, also where a browser numbered a file: ``ada (1).ipynb``.

        Such a file is the only one of its name, or it has a rival and is nobody's.
        """
        found = self.find(claim)
        called = _DOWNLOADED_AGAIN.sub("", claim.called)
        if found.people or found.likely or called in ("", claim.called):
            return found
        again = self.find(replace(claim, called=called))
        return replace(again, strength=_BY_COPY) if len(again.people) == 1 else found

    def find(self, claim: Claim) -> Fits:
        """The people that a claim fits."""
        if claim.number:
            fits = self._by(claim.number, "number")
            # The number counts for one assignment: with another's worksheet the name differs.
            agreeing = tuple(person for person in fits if _agrees(person, claim))
            if len(agreeing) == 1:
                return Fits(agreeing, _BY_IDENTIFIER)
            if fits:
                return Fits(
                    (),
                    _BY_IDENTIFIER,
                    f"participant {claim.number} is {fits[0].name} in the class list; check that "
                    "the worksheet is that of this assignment",
                )
        strong = [
            fits
            for fits in (
                self._by(claim.id, "id", "login"),
                self._by(claim.email, "email", "login"),
                self._by(claim.login, "login", "email", "sis_id"),
                self._by(claim.called, *_IDENTIFIERS),
            )
            if fits
        ]
        if strong:
            common = set(strong[0]).intersection(*strong[1:])
            if len(common) == 1:
                return Fits(tuple(common), _BY_IDENTIFIER)
            every = tuple(dict.fromkeys(person for fits in strong for person in fits))
            return Fits(every, _BY_IDENTIFIER, f"{claim.text()!r} {_fits(every)}")
        return self._by_name(claim)

    def _by_name(self, claim: Claim) -> Fits:
        name = claim.name or claim.called
        fits = self._named(name) if name else ()
        if not fits and claim.number and "-" in name:
            return self._in_a_group(name)
        fits = fits or self._by(claim.login or claim.called, "local part")
        agreeing = tuple(person for person in fits if not _contradicts(person, claim))
        if fits and not agreeing:
            reason = (
                f"{fits[0].text()} has this name, but the submission's login, e-mail address or "
                "number is another"
            )
            return Fits((), _BY_NAME, reason)
        if len(agreeing) == 1:
            return Fits(agreeing, _BY_NAME)
        likely = () if agreeing else self._typed_otherwise(name)
        reason = f"{claim.text()!r} {_fits(agreeing)}"
        if likely:
            reason = f"{reason}; it may be {' or '.join(person.text() for person in likely[:4])}"
        return Fits(agreeing, _BY_NAME, reason, likely)

    def _typed_otherwise(self, name: str) -> tuple[Person, ...]:
        """The people whose names have the same letters on another keyboard: never certain."""
        return tuple(self._typed.get(typed_letters(name), ()))

    def _in_a_group(self, name: str) -> Fits:
        """The people whose name follows that of a group, as Moodle writes ``Group A-Ada Lovelace``.

        It is certain only if the list says that they are in the group: without it,
        ``Jean-Luc Picard`` would be Luc Picard in a group that is called Jean.
        """
        likely: list[Person] = []
        for cut in re.finditer("-", name):
            group = plain_name(name[: cut.start()])
            fits = self._named(name[cut.end() :])
            inside = tuple(person for person in fits if group in groups_of(person))
            if inside:
                reason = "" if len(inside) == 1 else f"{name!r} {_fits(inside)}"
                return Fits(inside, _BY_NAME, reason)
            likely += fits
        if not likely:
            return Fits((), _BY_NAME, f"{name!r} {_fits(())}")
        reason = f"{name!r} {_fits(likely)}, if what stands before the name is a group"
        return Fits((), _BY_NAME, reason, tuple(likely))

    def _named(self, name: str) -> tuple[Person, ...]:
        plain = plain_name(name)
        ways = (plain, plain, without_accents(plain), bare_letters(plain))
        for names, way in zip(self._names, ways, strict=True):
            if way in names:
                return tuple(names[way])
        return ()

    def _by(self, value: str, *kinds: str) -> tuple[Person, ...]:
        """The people of whom one of the kinds of identifier is ``value``: the first that is."""
        called = value.strip().casefold()
        for kind in kinds if called else ():
            if fits := self._strong.get((kind, called)):
                return tuple(fits)
        return ()


def groups_of(person: Person) -> set[str]:
    """The groups of which a person is one, as plain names; systems list several with commas."""
    return {plain_name(group) for group in re.split(r"[,;|]", person.section)} - {""}


def _agrees(person: Person, claim: Claim) -> bool:
    """Whether the names do not speak against a participant number."""
    if not claim.name or not person.name or is_anonymous(claim.name):
        return True
    ways = {bare_letters(way) for way in spellings(person.name)}
    words = plain_name(claim.name).split()
    # "Group A-Ada Lovelace": a group's name may come first.
    return any(bare_letters(" ".join(words[n:])) in ways for n in range(len(words)))


def _contradicts(person: Person, claim: Claim) -> bool:
    """Whether both say something of the same kind, and it differs."""
    for value, known in (
        (claim.id, (person.id, person.sis_id)),
        (claim.email, (person.email,)),
        (claim.login, (person.login, person.github)),
        (claim.number, (person.number,)),
    ):
        of_person = {text.strip().casefold() for text in known if text}
        if value and of_person and value.strip().casefold() not in of_person:
            return True
    return False


# Which field answers which kind of claim: a number is an id whoever gave it.
_KINDS = (
    ("id", "id"),
    ("sis_id", "id"),
    ("sis_id", "sis_id"),
    ("login", "login"),
    ("github", "login"),
    ("email", "email"),
    ("number", "number"),
    ("submission", "submission"),
)
_IDENTIFIERS = ("submission", "login", "email", "id")


def _fits(people: Iterable[Person]) -> str:
    names = [person.text() for person in people]
    if not names:
        return "fits nobody in the class list"
    return f"fits {' and '.join(names[:4])}"
