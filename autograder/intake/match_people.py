"""Whose a submission is: a person of the class list if that is certain, and otherwise nobody.

A login, an e-mail address, an id or a participant number settles it; a name does where only one
person and only one submission has it. What fits two people, or none, is never guessed: the match
says so and gives the line for ``students.toml`` that settles it.
"""

from __future__ import annotations

import re
import unicodedata
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from autograder.exchange.printable import printable
from autograder.intake.download_names import claim_of
from autograder.intake.origin import Claim, Origin
from autograder.intake.person import Person

NOBODY = "nobody"  # in students.toml: this submission is not to be graded for anybody


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


@dataclass(frozen=True)
class _Found:
    """The people that one claim fits, and how strongly."""

    people: tuple[Person, ...]
    strength: int
    reason: str = ""
    likely: tuple[Person, ...] = ()  # whom it may fit, though that is not known


_BY_COPY, _BY_NAME, _BY_IDENTIFIER, _SETTLED = -1, 0, 1, 2
_DOWNLOADED_AGAIN = re.compile(r"\s*\(\d{1,9}\)\Z")


def match_all(
    people: Sequence[Person],
    origins: Mapping[str, Origin],
    settled: Mapping[str, str] | None = None,
) -> dict[str, Match]:
    """Whose each submission is, by the student's key.

    ``settled`` is what ``students.toml`` says: a prefix or key of a submission, and a login, an
    e-mail address, an id or a unique name of a person (several with commas, for a group).
    """
    index = _Index(people)
    said = {key.casefold(): value for key, value in (settled or {}).items()}
    found: dict[str, list[_Found]] = {}
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
    key: str, origin: Origin, entries: list[_Found], claimed: Mapping[Person, Mapping[str, int]]
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


class _Index:
    """The people by everything that they can be found by."""

    def __init__(self, people: Sequence[Person]) -> None:
        self._strong: dict[tuple[str, str], list[Person]] = defaultdict(list)
        # From the name as it is written to its bare letters, without order, accents and spaces: the
        # first that anybody has decides.
        self._names: tuple[dict[str, list[Person]], ...] = tuple(
            defaultdict(list) for _ in range(4)
        )
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
            spellings = _spellings(person.name)
            levels = (
                {plain_name(person.name), plain_name(_first_name_first(person.name))},
                spellings,
                {_without_accents(name) for name in spellings},
                {_bare(name) for name in spellings},
            )
            for names, level in zip(self._names, levels, strict=True):
                for name in level - {""}:
                    names[name].append(person)

    def settle(self, value: str) -> list[_Found]:
        """The people that a line of students.toml names."""
        if value.strip().casefold() == NOBODY:
            return [_Found((), _SETTLED, "students.toml says that it is nobody's")]
        whole = self._settle_one(value)
        if len(whole.people) == 1 or "," not in value:
            return [whole]
        return [self._settle_one(part) for part in value.split(",") if part.strip()]

    def _settle_one(self, value: str) -> _Found:
        fits = self._by(value, *_IDENTIFIERS) or self._named(value)
        reason = "" if len(fits) == 1 else f"{value!r} in students.toml {_fits(fits)}"
        return _Found(fits, _SETTLED, reason)

    def find_all(self, claim: Claim) -> list[_Found]:
        """The people that a claim fits: all of a group, where Moodle names the group alone.

        That is what it does where a team hands in together: ``Group A_55``, with the number of the
        group. (mod/assign/classes/downloader.php)
        """
        if claim.number and not self._named(claim.name):
            members = self._members.get(plain_name(claim.name), [])
            if members:
                return [_Found((person,), _BY_NAME) for person in members]
        return [self.find_file(claim)]

    def find_file(self, claim: Claim) -> _Found:
        """The people that a claim fits, also where a browser numbered a file: ``ada (1).ipynb``.

        Such a file is the only one of its name, or it has a rival and is nobody's.
        """
        found = self.find(claim)
        called = _DOWNLOADED_AGAIN.sub("", claim.called)
        if found.people or found.likely or called in ("", claim.called):
            return found
        again = self.find(replace(claim, called=called))
        return replace(again, strength=_BY_COPY) if len(again.people) == 1 else found

    def find(self, claim: Claim) -> _Found:
        """The people that a claim fits."""
        if claim.number:
            fits = self._by(claim.number, "number")
            # The number counts for one assignment: with another's worksheet the name differs.
            agreeing = tuple(person for person in fits if _agrees(person, claim))
            if len(agreeing) == 1:
                return _Found(agreeing, _BY_IDENTIFIER)
            if fits:
                return _Found(
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
                return _Found(tuple(common), _BY_IDENTIFIER)
            every = tuple(dict.fromkeys(person for fits in strong for person in fits))
            return _Found(every, _BY_IDENTIFIER, f"{claim.text()!r} {_fits(every)}")
        return self._by_name(claim)

    def _by_name(self, claim: Claim) -> _Found:
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
            return _Found((), _BY_NAME, reason)
        if len(agreeing) == 1:
            return _Found(agreeing, _BY_NAME)
        return _Found(agreeing, _BY_NAME, f"{claim.text()!r} {_fits(agreeing)}")

    def _in_a_group(self, name: str) -> _Found:
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
                return _Found(inside, _BY_NAME, reason)
            likely += fits
        if not likely:
            return _Found((), _BY_NAME, f"{name!r} {_fits(())}")
        reason = f"{name!r} {_fits(likely)}, if what stands before the name is a group"
        return _Found((), _BY_NAME, reason, tuple(likely))

    def _named(self, name: str) -> tuple[Person, ...]:
        plain = plain_name(name)
        ways = (plain, plain, _without_accents(plain), _bare(plain))
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
    spellings = {_bare(way) for way in _spellings(person.name)}
    words = plain_name(claim.name).split()
    # "Group A-Ada Lovelace": a group's name may come first.
    return any(_bare(" ".join(words[n:])) in spellings for n in range(len(words)))


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
_PARTICIPANTS = {
    *("participant", "teilnehmer in", "teilnehmerin", "teilnehmer", "participante"),
    *("partecipante", "deelnemer", "anon"),
}
_IDENTIFIERS = ("submission", "login", "email", "id")


def plain_name(name: str) -> str:
    """A name for comparing: one case, one space between words, no punctuation, accents kept.

    Letters that Unicode writes in two ways, and marks that only join or direct them, do not count.
    """
    text = unicodedata.normalize("NFKC", name).casefold()
    text = "".join(c for c in text if unicodedata.category(c) != "Cf")
    text = unicodedata.normalize("NFC", text)
    return " ".join(re.sub(r"(?:[^\w]|_)+", " ", text).split())


def is_anonymous(name: str) -> bool:
    """Whether a system gave the name because names are hidden from markers."""
    return plain_name(name) in _PARTICIPANTS


def _spellings(name: str) -> set[str]:
    """The ways in which systems write a name: both orders, and run together as Canvas does."""
    ways = {name, _first_name_first(name)}
    if "," not in name:
        # The family name is not marked: any cut may be the right one.
        words = plain_name(name).split()
        ways |= {" ".join(words[n:] + words[:n]) for n in range(1, len(words))}
    plain = {plain_name(way) for way in ways}
    plain |= {way.replace(" ", "") for way in plain}
    return plain - {""}


def _first_name_first(name: str) -> str:
    """``Lovelace, Ada`` as ``Ada Lovelace``."""
    last, _, first = (part.strip() for part in name.partition(","))
    return f"{first} {last}".strip()


def _without_accents(name: str) -> str:
    text = unicodedata.normalize("NFKD", name)
    return "".join(c for c in text if not unicodedata.combining(c))


def _bare(name: str) -> str:
    """The letters alone: Moodle leaves the apostrophe out of ``Seán O'Brien``, with no space."""
    return _without_accents(name).replace(" ", "")


def _fits(people: Iterable[Person]) -> str:
    names = [person.text() for person in people]
    if not names:
        return "fits nobody in the class list"
    return f"fits {' and '.join(names[:4])}"


def quoted(text: str) -> str:
    """A TOML string."""
    plain = printable(text, "?")
    return '"' + plain.replace("\\", "\\\\").replace('"', '\\"') + '"'
