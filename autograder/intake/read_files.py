"""The files of a submission, read into memory under caps: from zips, folders and notebooks.

Nothing is written to disk and no link is followed, so a name such as ``../../gradebook.db`` has
nowhere to lead. Only notebooks and saved responses are read, also from zips inside; what is passed
over is noted where somebody could have meant it to count.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from datetime import datetime
from pathlib import PurePosixPath
from typing import Protocol

from autograder.course import Settings
from autograder.errors import raise_if_short
from autograder.intake.archive import Archive, archive_from_bytes
from autograder.intake.download_names import moodle_name, rest_of
from autograder.intake.file_kinds import is_notebook_name, is_wanted
from autograder.intake.file_or_zip import Place, place_of
from autograder.intake.limits_on_files import Files, Kept
from autograder.intake.names_in_sentences import shown
from autograder.intake.notebook_reader import SUBMITTED, Unreadable
from autograder.intake.origin import Piece
from autograder.language import _

MAX_DEPTH = 8  # folders inside folders
MAX_ZIPS = 3  # zips inside zips
_OTHER_ARCHIVES = (".rar", ".7z", ".tar", ".tgz", ".gz", ".bz2", ".xz", ".zipx")
_OFFICE = (".docx", ".xlsx", ".pptx", ".odt", ".ods", ".jar", ".apk")


def read_files(pieces: Sequence[Piece], settings: Settings) -> Files:
    """The notebooks and saved responses of the pieces of a submission.

    Raises:
        Unreadable: if it cannot be opened or goes beyond a cap; the sentence says which.
    """
    files = Files(settings)
    reasons: list[str] = []
    for order, piece in enumerate(pieces):
        name = piece.name
        try:
            if piece.commit:
                from autograder.intake.repository import read_commit

                read_commit(piece, files, order)
                continue
            place = place_of(piece)
            if place.is_link:
                raise Unreadable(
                    _("{file} is a link or a device; hand in a zip or a notebook.").format(
                        file=shown(name)
                    )
                )
            if place.is_folder:
                label = PurePosixPath(name) if _is_part(pieces, name) else PurePosixPath()
                _read_folder(place, label, files, order, 0)
            else:
                _read_single(place, PurePosixPath(rest_of(name)), files, order)
        except OSError as error:
            raise_if_short(error)
            sentence = _("{file} cannot be opened: {reason}.")
            reasons.append(sentence.format(file=shown(name), reason=error.strerror or error))
        except Unreadable as unreadable:
            if len(pieces) == 1:
                raise
            reasons.append(str(unreadable))
    if reasons and not files.kept:
        raise Unreadable(" ".join(reasons[:3]))
    for reason in reasons:
        files.note(reason)
    return files


def _is_part(pieces: Sequence[Piece], name: str) -> bool:
    """Whether a folder's name belongs to the paths: the system's own does not."""
    return len(pieces) > 1 and moodle_name(name) is None


class _Entries(Protocol):
    """What `_read_entry` needs of a file, wherever it is."""

    is_link: bool
    time: datetime | None

    def read(self, limit: int) -> bytes: ...


def _read_single(place: Place, name: PurePosixPath, files: Files, order: int) -> None:
    """A submission, or a piece of it, that is one file."""
    lower = name.name.lower()
    if is_notebook_name(lower):
        data = place.read(files.limit(name))
        files.add(name, Kept(data, order, place.time))
        return
    if lower.endswith(_OTHER_ARCHIVES):
        raise Unreadable(
            _("{file} is an archive of another kind; unpack it and hand in a zip.").format(
                file=shown(name.name)
            )
        )
    limit = files.settings.submission_mb * 2**20
    data = place.read(limit if lower.endswith(".zip") else min(limit, 2**26))
    if lower.endswith(".zip"):
        if len(data) > limit:
            sentence = _("The zip is larger than {size} MB.")
            raise Unreadable(sentence.format(size=files.settings.submission_mb))
        archive = archive_from_bytes(data, files.settings.submission_files)
        _read_archive(archive, PurePosixPath(), files, order, 1)
        return
    if not lower.endswith(_OFFICE) and _looks_like_zip(data, files):
        archive = archive_from_bytes(data, files.settings.submission_files)
        sentence = _("{file} is a zip under another name; it was read as one.")
        files.note(sentence.format(file=shown(name.name)))
        _read_archive(archive, PurePosixPath(), files, order, 1)
        return
    if lower.endswith((".json", ".txt")) and data.lstrip(b"\xef\xbb\xbf \r\n\t")[:1] == b"{":
        files.add(name.with_name(name.stem + ".ipynb"), Kept(data, order, place.time))
        return
    sentence = _("{file} is neither a zip nor a notebook; hand in one of these.")
    raise Unreadable(sentence.format(file=shown(name.name)))


def _looks_like_zip(data: bytes, files: Files) -> bool:
    if data[:4] != b"PK\x03\x04":
        return False
    try:
        archive = archive_from_bytes(data, files.settings.submission_files)
    except Unreadable:
        return False
    return archive.has_wanted((".ipynb", ".zip"))


def _read_folder(folder: Place, at: PurePosixPath, files: Files, order: int, depth: int) -> None:
    if depth > MAX_DEPTH:
        files.note(_("Folders more than {count} deep were not read.").format(count=MAX_DEPTH))
        return
    for place in folder.children():
        files.count()
        path = at / place.name
        if place.is_link:
            if is_wanted(path) or not place.name.startswith("."):
                files.note(
                    _("{file} is a link; it was not followed.").format(file=shown(str(path)))
                )
        elif place.is_folder:
            if not place.name.startswith((".", "__")):
                _read_folder(place, path, files, order, depth + 1)
        else:
            _read_entry(place, path, files, order, 0)


def _read_archive(archive: Archive, at: PurePosixPath, files: Files, order: int, zips: int) -> None:
    for note in archive.notes:
        if any(end in note for end in (".ipynb", ".json")):
            files.note(note)
    for name in archive.entries:
        files.count()
        path = at / name
        if len(PurePosixPath(name).parts) > MAX_DEPTH + 1:
            files.note(_("Folders more than {count} deep were not read.").format(count=MAX_DEPTH))
            continue
        _read_entry(_Entry(archive, name), path, files, order, zips)


class _Entry:
    """An entry of a zip as `_read_entry` wants it."""

    def __init__(self, archive: Archive, name: str) -> None:
        self._archive, self._name = archive, name
        self.time = archive.time(name)
        self.is_link = archive.is_link(name)

    def read(self, limit: int) -> bytes:
        return self._archive.read(self._name, limit)


def _read_entry(
    entry: _Entries | Place, path: PurePosixPath, files: Files, order: int, zips: int
) -> None:
    hidden = any(part.startswith((".", "__")) for part in path.parts)
    if is_wanted(path):
        if entry.is_link:
            files.note(_("{file} is a link; it was not followed.").format(file=shown(str(path))))
            return
        files.add(path, Kept(entry.read(files.limit(path)), order, entry.time))
    elif hidden or entry.is_link:
        return
    elif path.suffix.lower() == ".zip":
        _read_nested(entry, path, files, order, zips)
    elif path.name == SUBMITTED and not files.hint:
        text = entry.read(100)
        files.spend(len(text))
        files.hint = text.decode("ascii", "replace").strip()
    elif path.suffix.lower() in _OTHER_ARCHIVES:
        sentence = _("{file} is an archive of another kind; it was not opened.")
        files.note(sentence.format(file=shown(str(path))))


def _read_nested(
    entry: _Entries | Place, path: PurePosixPath, files: Files, order: int, zips: int
) -> None:
    if zips >= MAX_ZIPS:
        sentence = _("{file} is a zip in {count} others; it was not opened.")
        files.note(sentence.format(file=shown(str(path)), count=zips))
        return
    try:
        data = entry.read(files.limit(path))
        files.spend(len(data))
        archive = archive_from_bytes(data, files.settings.submission_files)
    except Unreadable as unreadable:
        if files._bytes_left < 0:
            raise
        files.note(f"{shown(str(path))}: {_uncapitalised(str(unreadable))}")
        return
    # A zip that lies beside what it was made of (`submit()` writes it there) holds the same again.
    _read_archive(archive, path.parent / f"{path.stem}", files, order, zips + 1)


def _uncapitalised(sentence: str) -> str:
    return re.sub(r"^The zip", "the zip", sentence)
