"""When a submission says itself that it was packed: a hint, for students can change it."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime

from autograder.course import Settings
from autograder.intake.archive import Archive, archive_from_bytes
from autograder.intake.file_or_zip import Place, is_zip, place_of
from autograder.intake.notebook_reader import SUBMITTED, Unreadable
from autograder.intake.origin import Piece
from autograder.intake.time_spellings import read_time

_LARGEST = 256 * 2**20
_MOST_FILES = Settings().submission_files


def hinted_time(pieces: Sequence[Piece]) -> datetime | None:
    """The time that `submit()` wrote into any of the pieces, the latest of several."""
    found = []
    for piece in pieces:
        if piece.commit:
            continue
        try:
            found += _hints(place_of(piece))
        except (Unreadable, OSError):
            continue
    return max(found, default=None)


def _hints(place: Place) -> list[datetime]:
    if place.is_link:
        return []
    if is_zip(place):
        data = place.read(_LARGEST)
        return _in_archive(archive_from_bytes(data, _MOST_FILES)) if len(data) <= _LARGEST else []
    found = []
    below = place.children() if place.is_folder else []
    folders = [child for child in below if child.is_folder and child.name == "notebooks"]
    for child in (*below, *(c for folder in folders for c in folder.children())):
        if child.is_folder or child.is_link:
            continue
        if child.name == SUBMITTED:
            found += _read(child.read(100))
        elif child.name.lower() == "submission.zip":
            found += _hints(child)
    return found


def _in_archive(archive: Archive) -> list[datetime]:
    return [
        time
        for name in archive.entries
        if name.rpartition("/")[2] == SUBMITTED
        for time in _read(archive.read(name, 100))
    ]


def _read(data: bytes) -> list[datetime]:
    time = read_time(data.decode("ascii", "replace"), None)
    return [] if time is None else [time]
