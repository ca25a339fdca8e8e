"""Places in the class list, so that neighbours there have other numbers, in a file without names.

A bundle must not say who is in the class. So ``places.toml`` holds no name and no hash of one, but
a table of slots: a name chooses three of them, and what these add up to, modulo how many people
there are, is its place. A name that is not in the list gets one of the same places by chance, so
that nobody can tell which of the two it was. (A Bloomier
filter: Chazelle et al., "The Bloomier filter", SODA 2004; filled by peeling, as Botelho et al.,
"Simple and space-efficient minimal perfect hash functions", WADS 2007.)
"""

from __future__ import annotations

import hashlib
from base64 import b64decode, b64encode
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from msgspec import Meta

from autograder.course.toml_file import read_toml
from autograder.errors import UsageError
from autograder.questions.author_tables import Written
from autograder.questions.strict_reader import Place, read_table
from autograder.questions.variables import canonical

FILE = "places.toml"
MOST = 20_000  # names: a slot has two bytes
_BESIDE = 8  # slots beyond what is needed on average, so that small classes find theirs too
_TRIES = 1000  # each succeeds more often than not
_HEAD = "# Written by `autograder deal`: where everybody stands in the class list, without names.\n"


class _WrittenPlaces(Written, frozen=True, kw_only=True):
    people: Annotated[int, Meta(ge=1, le=MOST)]
    salt: int
    slots: str

    def __post_init__(self) -> None:
        super().__post_init__()
        try:
            right = len(b64decode(self.slots, validate=True)) % 6 == 0 and bool(self.slots)
        except ValueError:
            right = False
        if not right:
            raise ValueError("slots are not as `autograder deal` writes them; run it again")


@dataclass(frozen=True)
class Places:
    """Everybody's place, from 0; ``slots`` are in three equal parts, and a name has one in each."""

    people: int
    salt: int
    slots: tuple[int, ...]

    def of(self, student: str) -> int:
        """The place of a name or number of the class list; any place for others."""
        total = sum(self.slots[at] for at in _slots_of(student, self.salt, len(self.slots) // 3))
        return total % self.people

    def text(self) -> str:
        """What `read_places` reads."""
        packed = b64encode(b"".join(slot.to_bytes(2, "big") for slot in self.slots)).decode()
        return f'{_HEAD}people = {self.people}\nsalt = {self.salt}\nslots = "{packed}"\n'


def read_places(root: Path) -> Places | None:
    """The places of the class; None where no class list was dealt.

    Raises:
        CourseError: if the file is not as `autograder deal` writes it.
    """
    path = root / FILE
    if not path.exists():
        return None
    text, table = read_toml(path, "")
    written = read_table(table, _WrittenPlaces, Place(str(path), text, ()))
    data = b64decode(written.slots)
    slots = (int.from_bytes(data[at : at + 2], "big") for at in range(0, len(data), 2))
    return Places(written.people, written.salt, tuple(slots))


def make_places(wanted: Mapping[str, int]) -> Places:
    """Slots that give each name its place, from 0; places are as many as the largest says.

    Raises:
        UsageError: if there are none or too many names.
    """
    names = {canonical(name): place for name, place in wanted.items()}
    if not 0 < len(names) <= MOST:
        raise UsageError(f"The class list has {len(names):,} names; give 1 to {MOST:,}.")
    people = max(names.values()) + 1
    part = int(0.42 * len(names)) + _BESIDE
    for salt in range(_TRIES):
        chosen = {name: _slots_of(name, salt, part) for name in names}
        order = _peel(chosen, 3 * part)
        if order is None:
            continue
        slots = [_digest(salt, at)[0] % people for at in range(3 * part)]  # no slot tells of use
        for name, free in reversed(order):
            others = sum(slots[at] for at in chosen[name] if at != free)
            slots[free] = (names[name] - others) % people
        return Places(people, salt, tuple(slots))
    raise AssertionError("no salt fits")


def _slots_of(student: str, salt: int, part: int) -> tuple[int, int, int]:
    first, second, third = _digest(salt, canonical(student))
    return first % part, part + second % part, 2 * part + third % part


def _digest(salt: int, what: str | int) -> tuple[int, int, int]:
    digest = hashlib.sha256(f"{salt}\0{what!r}".encode("utf-8", "surrogatepass")).digest()
    first, second, third = (int.from_bytes(digest[8 * i : 8 * i + 8], "big") for i in range(3))
    return first, second, third


def _peel(chosen: Mapping[str, tuple[int, int, int]], count: int) -> list[tuple[str, int]] | None:
    """The names in an order in which each has a slot that none of those after it has.

    With that slot; None if there is no such order.
    """
    users: list[set[str]] = [set() for _ in range(count)]
    for name, slots in chosen.items():
        for at in slots:
            users[at].add(name)
    alone = [at for at in range(count) if len(users[at]) == 1]
    order = []
    while alone:
        at = alone.pop()
        if len(users[at]) != 1:
            continue
        (name,) = users[at]
        order.append((name, at))
        for other in chosen[name]:
            users[other].discard(name)
            if len(users[other]) == 1:
                alone.append(other)
    return order if len(order) == len(chosen) else None
