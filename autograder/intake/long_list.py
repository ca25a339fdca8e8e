"""A list for classes of any size: once it is long, only its end is in memory."""

from __future__ import annotations

import json
import tempfile
from array import array
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import IO, Any, Generic, TypeVar, overload

import msgspec

from autograder.errors import machine_error
from autograder.intake.origin import path_from_text, path_to_text

_BLOCK = 512  # items that are written, and read again, together

T = TypeVar("T")


class LongList(Sequence[T], Generic[T]):
    """A sequence that grows at its end; all but the last items lie in a file without a name.

    The file is one for all shelves, holds only what this process wrote, and is gone with it. Up to
    some hundred items nothing is written, and what is taken out is what was put in; beyond, it is
    equal. ``kind`` is their type: a dataclass of plain values and paths, or a plain type. Shelves
    are for one thread.

    Raises:
        MachineError: from `append`, if there is no room for the file.
    """

    def __init__(self, kind: type[T] | object, items: Iterable[T] = ()) -> None:
        self._kind = kind
        self._end: list[T] = []
        self._starts = array("Q")  # where in the file each block begins
        self._kept: tuple[int, list[T]] = (-1, [])
        self.extend(items)

    def append(self, item: T) -> None:
        """Put an item at the end."""
        self._end.append(item)
        if len(self._end) == 2 * _BLOCK:
            self._write(self._end[:_BLOCK])
            del self._end[:_BLOCK]

    def extend(self, items: Iterable[T]) -> None:
        """Put all of them at the end."""
        for item in items:
            self.append(item)

    def __iadd__(self, items: Iterable[T]) -> LongList[T]:
        self.extend(items)
        return self

    def __len__(self) -> int:
        return len(self._starts) * _BLOCK + len(self._end)

    def __iter__(self) -> Iterator[T]:
        for number in range(len(self._starts)):
            yield from self._read(number)
        yield from self._end

    @overload
    def __getitem__(self, index: int) -> T: ...

    @overload
    def __getitem__(self, index: slice) -> list[T]: ...

    def __getitem__(self, index: int | slice) -> T | list[T]:
        if isinstance(index, slice):
            return [self[number] for number in range(*index.indices(len(self)))]
        number = index + len(self) if index < 0 else index
        if not 0 <= number < len(self):
            raise IndexError(index)
        block, place = divmod(number, _BLOCK)
        if block >= len(self._starts):
            return self._end[number - len(self._starts) * _BLOCK]
        if self._kept[0] != block:
            self._kept = block, self._read(block)
        return self._kept[1][place]

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Sequence):
            return NotImplemented
        return len(self) == len(other) and all(map(lambda a, b: bool(a == b), self, other))

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"LongList({list(self)!r})"

    def _write(self, items: list[T]) -> None:
        try:
            file = _file()
            start = file.seek(0, 2)
            # As JSON in ASCII: names of files need not be text in any encoding.
            plain = msgspec.to_builtins(items, enc_hook=_as_plain)
            file.write(json.dumps(plain).encode() + b"\n")
            self._starts.append(start)
        except OSError as error:
            raise machine_error(error, tempfile.gettempdir()) or error from None

    def _read(self, block: int) -> list[T]:
        file = _file()
        file.seek(self._starts[block])
        kinds = list[self._kind]  # type: ignore[name-defined]
        items: list[T] = msgspec.convert(json.loads(file.readline()), kinds, dec_hook=_from_plain)
        return items


@cache
def _file() -> IO[bytes]:
    """One for all shelves: of files that are open, a process may have few."""
    return tempfile.TemporaryFile()


def _as_plain(value: object) -> object:
    if isinstance(value, Path):
        return path_to_text(value)
    raise TypeError(type(value).__name__)


def _from_plain(kind: type, value: Any) -> object:
    if issubclass(kind, Path):
        return path_from_text(value)
    raise TypeError(kind.__name__)
