"""A place where something was handed in: a file or folder on disk, or inside a zip, seen alike."""

from __future__ import annotations

import os
import stat
from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Protocol

from autograder.errors import raise_if_short
from autograder.intake.archive import Archive, open_archive, open_regular
from autograder.intake.names_in_sentences import shown
from autograder.intake.notebook_reader import Unreadable
from autograder.intake.origin import Piece


class Place(Protocol):
    """A file or a folder, wherever it is."""

    @property
    def name(self) -> str:
        """The last part of its path."""
        ...

    @property
    def is_folder(self) -> bool:
        """Whether there can be something below it."""
        ...

    @property
    def is_link(self) -> bool:
        """Whether it only points somewhere; it is never followed."""
        ...

    @property
    def piece(self) -> Piece:
        """The place as a part of a submission."""
        ...

    @property
    def time(self) -> datetime | None:
        """When it was last changed, as far as the place knows."""
        ...

    def children(self) -> Sequence[Place]:
        """What is directly below, by name; nothing below a file."""
        ...

    def read(self, limit: int) -> bytes:
        """At most ``limit + 1`` bytes of a file."""
        ...

    def text(self) -> str:
        """Where it is, for a person."""
        ...


class DiskPlace:
    """A file or a folder on disk."""

    # Of a class there is one for each submission: no dictionary, and no Path before it is wanted.
    __slots__ = ("_below", "_kind", "_parent", "name")

    def __init__(self, path: Path) -> None:
        self.name = path.name
        self._parent = str(path.parent) if path.name else str(path)
        self._kind: int | None = None
        self._below: list[DiskPlace] | None = None

    @classmethod
    def _in(cls, parent: str, name: str) -> DiskPlace:
        place = cls.__new__(cls)
        place.name, place._parent, place._kind, place._below = name, parent, None, None
        return place

    @property
    def path(self) -> Path:
        """The path, absolute if the one that led here was."""
        return Path(self._parent, self.name)

    @property
    def _mode(self) -> int:
        if self._kind is None:
            self._kind = os.lstat(os.path.join(self._parent, self.name)).st_mode
        return self._kind

    @property
    def is_folder(self) -> bool:
        return stat.S_ISDIR(self._mode)

    @property
    def is_link(self) -> bool:
        return stat.S_ISLNK(self._mode)

    @property
    def piece(self) -> Piece:
        return Piece(self.path)

    @property
    def time(self) -> datetime | None:
        try:
            return datetime.fromtimestamp(self.path.lstat().st_mtime, UTC)
        except (OSError, ValueError, OverflowError):
            return None

    def children(self) -> Sequence[Place]:
        if self._below is None:
            names = sorted(os.listdir(self.path)) if self.is_folder else []
            parent = str(self.path)
            self._below = [DiskPlace._in(parent, name) for name in names]
        return self._below

    def read(self, limit: int) -> bytes:
        with open_regular(self.path) as stream:
            return stream.read(limit + 1)

    def text(self) -> str:
        return str(self.path)


class ZipPlace:
    """A file or a folder inside a zip; the empty path is the whole of it.

    ``outer`` leads from the file on disk to the zip, when zips are in zips.
    """

    def __init__(self, disk: Path, outer: tuple[str, ...], inside: str, is_folder: bool) -> None:
        self.disk, self.outer, self.inside = disk, outer, inside
        self.is_folder = is_folder
        self.name = inside.rpartition("/")[2] or (
            outer[-1].rpartition("/")[2] if outer else disk.name
        )

    @property
    def archive(self) -> Archive:
        """The zip that it is in."""
        return open_archive(self.disk, self.outer)

    @property
    def is_link(self) -> bool:
        return not self.is_folder and self.archive.is_link(self.inside)

    @property
    def piece(self) -> Piece:
        if not self.inside:
            return Piece(self.disk, self.outer)
        return Piece(self.disk, (*self.outer, self.inside + ("/" if self.is_folder else "")))

    @property
    def time(self) -> datetime | None:
        return self.archive.time(self.inside)

    def children(self) -> Sequence[Place]:
        if not self.is_folder:
            return []
        inside = self.archive.folders.get(self.inside, {})
        start = f"{self.inside}/" if self.inside else ""
        return [
            ZipPlace(self.disk, self.outer, start + name, is_folder)
            for name, is_folder in sorted(inside.items())
        ]

    def read(self, limit: int) -> bytes:
        return self.archive.read(self.inside, limit)

    def text(self) -> str:
        return "/".join((str(self.disk), *self.outer, self.inside)).rstrip("/")


class Group:
    """Several places seen as one folder, as the shell's ``work/*`` gives them."""

    is_folder, is_link, time = True, False, None

    def __init__(self, name: str, places: Sequence[Place], at: Piece) -> None:
        self.name, self._places, self.piece = name, places, at

    def children(self) -> Sequence[Place]:
        return self._places

    def read(self, limit: int) -> bytes:
        raise IsADirectoryError(self.name)

    def text(self) -> str:
        return str(self.piece.path)


def as_folder(place: Place) -> Place | None:
    """A folder as it is, a zip as the folder that it holds; None for anything else.

    Raises:
        Unreadable: if the zip cannot be opened.
    """
    if place.is_folder:
        return place
    if not is_zip(place) or place.is_link:
        return None
    piece = place.piece
    open_archive(piece.path, piece.inside)
    return ZipPlace(piece.path, piece.inside, "", True)


def as_folder_if_readable(place: Place) -> Place | None:
    """As `as_folder`, None for a zip that cannot be opened: reading it will say why."""
    try:
        return as_folder(place)
    except Unreadable:
        return None
    except OSError as error:
        raise_if_short(error)
        return None


def is_zip(place: Place) -> bool:
    """Whether it is called a zip."""
    return not place.is_folder and place.name.lower().endswith(".zip")


def place_of(piece: Piece) -> Place:
    """The place where a piece of a submission is.

    Raises:
        OSError: if there is nothing.
        Unreadable: if the zip on the way cannot be opened.
    """
    if not piece.inside:
        return DiskPlace(piece.path)
    *outer, last = piece.inside
    place = ZipPlace(piece.path, tuple(outer), last.rstrip("/"), last.endswith("/"))
    if not place.is_folder and place.inside not in place.archive.entries:
        raise Unreadable(f"{shown(last)} is no longer in {piece.path.name}.")
    return place
