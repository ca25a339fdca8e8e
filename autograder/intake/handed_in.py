"""The files of a submission, read into memory under caps: from a zip, a folder or one notebook.

Nothing is written to disk and no link is followed, so a name such as ``../../gradebook.db`` has
nowhere to lead. Only notebooks and saved responses are read; every other file is passed over.
"""

from __future__ import annotations

import io
import os
import stat
import zipfile
from collections.abc import Iterator
from pathlib import Path, PurePosixPath

from autograder.course import Settings
from autograder.intake.notebook_reader import Unreadable

MAX_DEPTH = 8  # folders inside folders
MAX_SIDECAR = 2**20
MAX_RATIO = 250  # deflate reaches about 1000; notebooks stay below 50
_BOMB_SIZE = 2**20  # below this a high ratio harms nobody
_CENTRAL_ENTRY = b"PK\x01\x02"


class Files:
    """The wanted files by their path inside the submission, and what was odd about the others."""

    def __init__(self, settings: Settings) -> None:
        self.data: dict[PurePosixPath, bytes] = {}
        self.notes: list[str] = []
        self._count_left = settings.submission_files
        self._bytes_left = settings.submission_mb * 2**20
        self._settings = settings

    def count(self) -> None:
        """Take notice of one more entry.

        Raises:
            Unreadable: if there are too many.
        """
        self._count_left -= 1
        if self._count_left < 0:
            raise Unreadable(
                f"It holds more than {self._settings.submission_files} files; "
                "hand in only the notebooks and the folder responses."
            )

    def has(self, path: PurePosixPath) -> bool:
        """Whether there is such a file already, which a note then says."""
        if path in self.data:
            self.notes.append(f"{_show(path)} is there twice; the first was taken.")
        return path in self.data

    def limit(self, path: PurePosixPath) -> int:
        """How many bytes the file at ``path`` may have."""
        return min(self._bytes_left, MAX_SIDECAR if path.suffix == ".json" else self._bytes_left)

    def add(self, path: PurePosixPath, data: bytes) -> None:
        """Keep a file, unless it is over its cap.

        Raises:
            Unreadable: if the submission as a whole is too large.
        """
        too_long = len(data) > self.limit(path)
        self._bytes_left -= len(data)  # what was read counts, kept or not
        if self._bytes_left < 0:
            raise Unreadable(
                f"It is larger than {self._settings.submission_mb} MB; "
                "clear the notebooks' outputs and hand it in again."
            )
        if too_long:
            self.notes.append(f"{_show(path)} is too large for saved responses; it was left out.")
            return
        self.data[path] = data


def read_files(path: Path, settings: Settings) -> Files:
    """The notebooks and saved responses of the submission at ``path``.

    Raises:
        Unreadable: if it cannot be opened or goes beyond a cap; the sentence says which.
    """
    files = Files(settings)
    try:
        mode = path.lstat().st_mode
        if stat.S_ISDIR(mode):
            _read_folder(path, files)
        elif not stat.S_ISREG(mode):
            raise Unreadable(f"{_show(path)} is a link or a device; hand in a zip or a notebook.")
        elif path.suffix.lower() == ".ipynb":
            name = PurePosixPath(path.name)
            files.add(name, _read_regular(path, files.limit(name)))
        elif path.suffix.lower() == ".zip":
            _read_zip(_read_regular(path, settings.submission_mb * 2**20), files)
        else:
            raise Unreadable(
                f"{_show(path)} is neither a zip nor a notebook; hand in one of these."
            )
    except OSError as error:
        raise Unreadable(f"{_show(path)} cannot be opened: {error.strerror or error}.") from None
    return files


def is_wanted(path: PurePosixPath) -> bool:
    """Whether the file is a notebook or a chapter's saved responses."""
    if any(part.startswith((".", "__")) for part in path.parts):
        return False  # .ipynb_checkpoints, __MACOSX
    if path.suffix.lower() == ".ipynb":
        return True
    return path.suffix == ".json" and path.parent.name == "responses"


def _read_folder(top: Path, files: Files) -> None:
    for path in _walk(top, files, 0):
        inside = PurePosixPath(path.relative_to(top).as_posix())
        if path.is_symlink():
            files.notes.append(f"{_show(inside)} is a link; it was not followed.")
        elif is_wanted(inside):
            files.add(inside, _read_regular(path, files.limit(inside)))


def _walk(folder: Path, files: Files, depth: int) -> Iterator[Path]:
    if depth > MAX_DEPTH:
        files.notes.append(f"Folders more than {MAX_DEPTH} deep were not read.")
        return
    with os.scandir(folder) as entries:
        listed = sorted(entries, key=lambda entry: entry.name)
    for entry in listed:
        files.count()
        if entry.is_dir(follow_symlinks=False):
            if not entry.name.startswith((".", "__")):
                yield from _walk(Path(entry.path), files, depth + 1)
        else:
            yield Path(entry.path)


def _read_regular(path: Path, limit: int) -> bytes:
    """At most ``limit + 1`` bytes of a file that is no link, no pipe and no device."""
    flags = os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
    descriptor = os.open(path, flags | getattr(os, "O_BINARY", 0))
    with os.fdopen(descriptor, "rb") as stream:
        if not stat.S_ISREG(os.fstat(descriptor).st_mode):
            raise Unreadable(f"{_show(path)} is no ordinary file; hand in a zip or a notebook.")
        return stream.read(limit + 1)


def _read_zip(data: bytes, files: Files) -> None:
    settings = files._settings
    if len(data) > settings.submission_mb * 2**20:
        raise Unreadable(f"The zip is larger than {settings.submission_mb} MB.")
    # Before zipfile makes an object of each entry: their number cannot be more than this.
    if data.count(_CENTRAL_ENTRY) > settings.submission_files:
        raise Unreadable(
            f"The zip holds more than {settings.submission_files} files; "
            "hand in only the notebooks and the folder responses."
        )
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            for entry in archive.infolist():
                _read_entry(archive, entry, files)
    except Unreadable:
        raise
    except Exception as error:  # zipfile raises many kinds on purposely broken archives
        raise Unreadable(f"The zip is damaged ({_one_line(error)}); make it again.") from None


def _read_entry(archive: zipfile.ZipFile, entry: zipfile.ZipInfo, files: Files) -> None:
    files.count()
    name = entry.filename.replace("\\", "/")
    path = PurePosixPath(name)
    if not path.parts or name.endswith("/"):
        return
    if name.startswith("/") or ".." in path.parts or ":" in path.parts[0]:
        files.notes.append(f"{_show(path)} leads out of the zip; it was left out.")
        return
    if len(path.parts) > MAX_DEPTH + 1:
        files.notes.append(f"Folders more than {MAX_DEPTH} deep were not read.")
        return
    if not is_wanted(path) or files.has(path):
        return
    if stat.S_ISLNK(entry.external_attr >> 16):
        files.notes.append(f"{_show(path)} is a link; it was not followed.")
        return
    if entry.flag_bits & 1:
        raise Unreadable("The zip is protected by a password; make it again without one.")
    if entry.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        raise Unreadable("The zip uses an unusual compression; make it again with another program.")
    with archive.open(entry) as stream:
        data = stream.read(files.limit(path) + 1)
    if len(data) > _BOMB_SIZE and len(data) > MAX_RATIO * max(entry.compress_size, 1):
        raise Unreadable(
            f"{_show(path)} in the zip grows to more than {MAX_RATIO} times its size, as a zip "
            "bomb does; clear the notebook's outputs and make the zip again."
        )
    files.add(path, data)


def _show(path: Path | PurePosixPath) -> str:
    """A file name from a student, fit for a sentence."""
    name = path.name or str(path)
    clean = "".join(c if c.isprintable() else "?" for c in name)
    return clean if len(clean) <= 80 else clean[:79] + "…"


def _one_line(error: Exception) -> str:
    text = " ".join(str(error).split()) or type(error).__name__
    return "".join(c if c.isprintable() else "?" for c in text)[:120]
