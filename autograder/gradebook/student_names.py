"""What to call each student: two of one name are told apart by their keys."""

from __future__ import annotations

from array import array
from collections import Counter
from collections.abc import Iterable
from typing import TYPE_CHECKING

from autograder.gradebook.record import Record

if TYPE_CHECKING:
    pass


def names_of(records: Iterable[Record]) -> dict[str, str]:
    """What to call each student, by key; two of one name are told apart by their keys."""
    called: dict[str, list[str]] = {}
    for record in records:
        called.setdefault(record.name, []).append(record.student)
    return {
        student: name if len(students) == 1 or name == student else f"{name} ({student})"
        for name, students in called.items()
        for student in students
    }


class Names:
    """As `names_of`, gathered one record after the other; who has no other name takes no room."""

    def __init__(self) -> None:
        self._named: dict[str, str] = {}
        self._count: Counter[str] = Counter()
        self._by_key = array("q")  # digests of the keys by which somebody is called

    def add(self, record: Record) -> None:
        """Take in one submission."""
        name = record.name
        if name == record.student:
            self._by_key.append(hash(name))
        else:
            self._named[record.student] = name
            self._count[name] += 1

    def settle(self) -> None:
        """After the last one: find the names that are somebody's key."""
        keys = set(self._by_key) if self._count else set()
        self._count.update(name for name in list(self._count) if hash(name) in keys)
        self._by_key = array("q")

    def __getitem__(self, student: str) -> str:
        name = self._named.get(student, student)
        return name if name == student or self._count[name] < 2 else f"{name} ({student})"
