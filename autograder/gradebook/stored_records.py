"""The records of a class of any size, read from the gradebook a few at a time."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import overload

from autograder.gradebook.book import Gradebook
from autograder.gradebook.record import Record

_AT_ONCE = 250
_KEPT = 500  # records of a class that is kept in memory once it was read


class StoredRecords(Sequence[Record]):
    """Everybody who was in the gradebook when this was made, by name; ``finish`` completes each.

    Going through it reads it; only a small class is kept. The gradebook has to stay open.
    """

    def __init__(self, book: Gradebook, finish: Callable[[Record], Record]) -> None:
        self._book, self._finish = book, finish
        self._students = book.students()
        self._kept: list[Record] | None = None

    def __len__(self) -> int:
        return len(self._students)

    def __iter__(self) -> Iterator[Record]:
        if len(self) > _KEPT:
            yield from self._read(self._students)
            return
        if self._kept is None:
            self._kept = list(self._read(self._students))
        yield from self._kept

    @overload
    def __getitem__(self, index: int) -> Record: ...

    @overload
    def __getitem__(self, index: slice) -> list[Record]: ...

    def __getitem__(self, index: int | slice) -> Record | list[Record]:
        if isinstance(index, slice):
            return list(self._read(self._students[index]))
        return next(self._read([self._students[index]]))

    def _read(self, students: Sequence[str]) -> Iterator[Record]:
        for start in range(0, len(students), _AT_ONCE):
            for record in self._book.records_of(students[start : start + _AT_ONCE]):
                yield self._finish(record)
