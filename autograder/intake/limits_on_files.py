"""How many files a submission may hold, and how large: counted and weighed as they are taken in."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime
from pathlib import PurePosixPath

from autograder.course import Settings
from autograder.intake.file_kinds import is_notebook_name
from autograder.intake.names_in_sentences import shown
from autograder.intake.notebook_reader import Unreadable
from autograder.language import _

MAX_SIDECAR = 2**20
_MOST_NOTES = 20


@dataclass(frozen=True)
class Kept:
    """A file that is wanted; of two for one chapter the later ``order`` and ``time`` are newer."""

    data: bytes
    order: int = 0
    time: datetime | None = None


class Files:
    """The wanted files by their path inside the submission, and what was odd about the others."""

    def __init__(self, settings: Settings) -> None:
        self.kept: dict[PurePosixPath, Kept] = {}
        self.notes: list[str] = []
        self.hint = ""
        self._count_left = settings.submission_files
        self._bytes_left = settings.submission_mb * 2**20
        self.settings = settings

    @property
    def data(self) -> dict[PurePosixPath, bytes]:
        """The bytes of each file."""
        return {path: kept.data for path, kept in self.kept.items()}

    def note(self, sentence: str) -> None:
        """Say what was odd, unless so much was that nobody would read it."""
        if sentence in self.notes:
            return
        if len(self.notes) == _MOST_NOTES:
            self.notes.append(_("More files than these were passed over."))
        if len(self.notes) < _MOST_NOTES:
            self.notes.append(sentence)

    def count(self) -> None:
        """Take notice of one more entry.

        Raises:
            Unreadable: if there are too many.
        """
        self._count_left -= 1
        if self._count_left < 0:
            raise Unreadable(
                _(
                    "It holds more than {count} files; hand in only the notebooks and the folder "
                    "responses."
                ).format(count=self.settings.submission_files)
            )

    def limit(self, path: PurePosixPath) -> int:
        """How many bytes the file at ``path`` may have."""
        is_sidecar = path.suffix == ".json" and not is_notebook_name(path.name)
        return min(self._bytes_left, MAX_SIDECAR if is_sidecar else self._bytes_left)

    def spend(self, size: int) -> None:
        """Count bytes that were read, whether they are kept or not.

        Raises:
            Unreadable: if the submission as a whole is too large.
        """
        self._bytes_left -= size
        if self._bytes_left < 0:
            raise Unreadable(
                _(
                    "It is larger than {size} MB; clear the notebooks' outputs and hand it in "
                    "again."
                ).format(size=self.settings.submission_mb)
            )

    def add(self, path: PurePosixPath, kept: Kept) -> None:
        """Keep a file, unless it is over its cap.

        Raises:
            Unreadable: if the submission as a whole is too large.
        """
        too_long = len(kept.data) > self.limit(path)
        self.spend(len(kept.data))
        if too_long:
            sentence = _("{file} is too large for saved responses; it was left out.")
            self.note(sentence.format(file=shown(path.name)))
            return
        while path in self.kept:  # of another piece
            path = path.with_name(f"{path.stem}_{path.suffix}")
        self.kept[path] = kept
