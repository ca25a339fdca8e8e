"""A zip as a tree of names, read without writing anything to disk.

Names that lead out of the zip lead nowhere: an absolute name or one with a drive is taken without
its beginning, one that climbs (``../``) is left out with the reason.
"""

from __future__ import annotations

import io
import os
import stat
import tempfile
import threading
import zipfile
from collections import OrderedDict
from datetime import UTC, datetime
from pathlib import Path
from typing import IO

from autograder.errors import raise_if_short
from autograder.intake.names_in_sentences import shown
from autograder.intake.notebook_reader import Unreadable
from autograder.language import _

MAX_RATIO = 250  # deflate reaches about 1000; notebooks stay below 50
_BOMB_SIZE = 24 * 2**20  # below this a high ratio harms nobody
_CENTRAL_ENTRY = b"PK\x01\x02"
_SPOOLED = 16 * 2**20
MAX_NESTED = 2 * 2**30  # a zip inside the zip of a class
_MAX_PARTS = 40
_LARGEST_DIRECTORY = 32 * 2**20  # some 300,000 entries


def _directory_size(stream: IO[bytes]) -> int:
    """The bytes of the list of entries, before an object is made of each."""
    end = getattr(zipfile, "_EndRecData", lambda stream: None)(stream)
    return int(end[5]) if end else 0


class Archive:
    """The entries of a zip by their cleaned paths, and what was odd about their names."""

    def __init__(self, stream: IO[bytes], most_files: int = 2_000_000) -> None:
        """Read the directory of a zip.

        Raises:
            Unreadable: if it is damaged or holds more than ``most_files`` entries.
        """
        self._lock = threading.Lock()
        self.notes: list[str] = []
        self.entries: dict[str, zipfile.ZipInfo] = {}
        self.folders: dict[str, dict[str, bool]] = {"": {}}
        try:
            if _directory_size(stream) > _LARGEST_DIRECTORY:
                raise Unreadable(_("The zip holds far too many files; hand in only the notebooks."))
            self._zip = zipfile.ZipFile(stream)
            listed = self._zip.infolist()
        except Unreadable:
            raise
        except Exception as error:  # zipfile raises many kinds on purposely broken archives
            raise damaged(error) from None
        if len(listed) > most_files:
            raise too_many_files(most_files)
        for entry in listed:
            self._take(entry)

    def _take(self, entry: zipfile.ZipInfo) -> None:
        name = entry.filename.replace("\\", "/")
        parts = [part for part in name.split("/") if part not in ("", ".")]
        if not parts or len(parts) > _MAX_PARTS:
            return
        if ".." in parts:
            self.notes.append(
                _(
                    "{file} lies at a path that leads out of the zip; it was left out. Zip the "
                    "folder of the notebooks itself."
                ).format(file=shown(parts[-1]))
            )
            return
        if len(parts[0]) == 2 and parts[0][1] == ":" and parts[0][0].isalpha():
            parts = parts[1:]
        if not parts:
            return
        path = "/".join(parts)
        is_folder = name.endswith("/") or (entry.external_attr & 0x10 and not entry.file_size)
        for depth in range(len(parts)):
            above = "/".join(parts[:depth])
            last = depth == len(parts) - 1
            inside = self.folders.setdefault(above, {})
            inside[parts[depth]] = inside.get(parts[depth], False) or not last or bool(is_folder)
        if is_folder:
            self.folders.setdefault(path, {})
        else:
            if path in self.entries:
                sentence = _("{file} is in the zip twice; the last was taken.")
                self.notes.append(sentence.format(file=shown(path)))
            self.entries[path] = entry  # the last of a name counts, as in every unzip tool

    def has_wanted(self, wanted: tuple[str, ...]) -> bool:
        """Whether there is a file whose name ends in one of these."""
        return any(path.lower().endswith(wanted) for path in self.entries)

    def is_link(self, path: str) -> bool:
        """Whether an entry is a symbolic link."""
        return stat.S_ISLNK(self.entries[path].external_attr >> 16)

    def time(self, path: str) -> datetime | None:
        """The time of an entry, as its maker's clock had it; zips keep no zone."""
        try:
            return datetime(*self.entries[path].date_time, tzinfo=UTC)
        except (KeyError, ValueError):
            return None

    def read(self, path: str, limit: int) -> bytes:
        """At most ``limit + 1`` bytes of a file.

        Raises:
            Unreadable: if it is encrypted, damaged, packed in an unusual way or a bomb.
        """
        entry = self._ordinary(path)
        try:
            with self._lock, self._zip.open(entry) as stream:
                data = stream.read(limit + 1)
        except Exception as error:
            raise damaged(error) from None
        if len(data) > _BOMB_SIZE and len(data) > MAX_RATIO * max(entry.compress_size, 1):
            raise Unreadable(
                _(
                    "{file} in the zip grows to more than {count} times its size, as a zip bomb "
                    "does; clear the notebook's outputs and make the zip again."
                ).format(file=shown(path), count=MAX_RATIO)
            )
        return data

    def open_nested(self, path: str) -> Archive:
        """A zip inside, however large up to `MAX_NESTED`; it is unpacked once.

        Raises:
            Unreadable: as `read`, or if it is no zip.
        """
        entry = self._ordinary(path)
        stream = tempfile.SpooledTemporaryFile(max_size=_SPOOLED)  # noqa: SIM115 -- the archive's
        try:
            with self._lock, self._zip.open(entry) as packed:
                left = MAX_NESTED
                while block := packed.read(2**20):
                    left -= len(block)
                    if left < 0:
                        sentence = _("{file} is larger than {size} MB.")
                        raise Unreadable(sentence.format(file=shown(path), size=MAX_NESTED >> 20))
                    stream.write(block)
        except Unreadable:
            raise
        except Exception as error:
            raise damaged(error) from None
        stream.seek(0)
        return Archive(stream)

    def _ordinary(self, path: str) -> zipfile.ZipInfo:
        entry = self.entries[path]
        if entry.flag_bits & 1:
            raise Unreadable(_("The zip is protected by a password; make it again without one."))
        if entry.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
            raise Unreadable(
                _("The zip uses an unusual compression; make it again with another program.")
            )
        return entry


def archive_from_bytes(data: bytes, most_files: int) -> Archive:
    """The zip of one submission, in memory.

    Raises:
        Unreadable: if it is damaged or holds too many files.
    """
    # Before zipfile makes an object of each entry: their number cannot be more than this.
    if data.count(_CENTRAL_ENTRY) > most_files:
        raise too_many_files(most_files)
    return Archive(io.BytesIO(data), most_files)


class _Cache:
    """The archives of classes that are open; those least used are closed."""

    def __init__(self, most: int) -> None:
        self._most, self._lock = most, threading.Lock()
        self._open: OrderedDict[tuple[object, ...], Archive] = OrderedDict()

    def get(self, path: Path, inside: tuple[str, ...]) -> Archive:
        status = path.stat()
        key = (path, status.st_size, status.st_mtime_ns, inside)
        with self._lock:
            if key in self._open:
                self._open.move_to_end(key)
                return self._open[key]
        if inside:
            archive = self.get(path, inside[:-1]).open_nested(inside[-1])
        else:
            archive = Archive(open_regular(path))
        with self._lock:
            self._open[key] = archive
            while len(self._open) > self._most:
                self._open.popitem(last=False)
        return archive


_cache = _Cache(8)


def open_archive(path: Path, inside: tuple[str, ...] = ()) -> Archive:
    """The zip at a path, or the zip in it to which ``inside`` leads; kept open for the next piece.

    Raises:
        OSError: if there is nothing to open.
        Unreadable: if it is no zip.
    """
    return _cache.get(path, inside)


def open_regular(path: Path) -> IO[bytes]:
    """A file that is no link, no pipe and no device, for reading.

    Raises:
        Unreadable: if it is one of these.
    """
    flags = os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
    descriptor = os.open(path, flags | getattr(os, "O_BINARY", 0))
    if not stat.S_ISREG(os.fstat(descriptor).st_mode):
        os.close(descriptor)
        raise Unreadable(
            _("{file} is not an ordinary file; hand in a zip or a notebook.").format(
                file=shown(path.name)
            )
        )
    return os.fdopen(descriptor, "rb")


def damaged(error: Exception) -> Unreadable:
    """What zipfile says of a broken archive, in a sentence.

    Raises:
        MachineError: if the error is not about the archive, but about this machine.
    """
    raise_if_short(error)
    text = " ".join(str(error).split()) or type(error).__name__
    text = "".join(c if c.isprintable() else "?" for c in text)[:120]
    return Unreadable(_("The zip is damaged ({reason}); make it again.").format(reason=text))


def too_many_files(most: int) -> Unreadable:
    """Too many entries."""
    return Unreadable(
        _(
            "It holds more than {count} files; hand in only the notebooks and the folder responses."
        ).format(count=most)
    )
