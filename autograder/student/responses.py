"""Responses kept beside the notebooks, a JSON file a chapter: the truth of what was answered."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path

from filelock import FileLock, Timeout

from autograder.errors import AutograderError
from autograder.exchange.identity import FILE
from autograder.exchange.responses import Entry
from autograder.language import _, n_
from autograder.student.course_path import notebooks_folder

LOCK_SECONDS = 10.0


class ResponsesError(AutograderError):
    """A response could not be kept."""


def responses_folder(course_root: Path) -> Path:
    """The folder ``responses`` beside the notebook that is running.

    The environment variable ``AUTOGRADER_RESPONSES`` names another one.
    """
    given = os.environ.get("AUTOGRADER_RESPONSES")
    return Path(given) if given else notebooks_folder(course_root) / "responses"


class Responses:
    """The responses to one chapter's questions.

    ``rescue`` is asked for entries that are known from elsewhere when the file is missing or
    damaged.
    """

    def __init__(
        self, folder: Path, chapter: str, rescue: Callable[[], dict[str, Entry]] = dict
    ) -> None:
        self.path = folder / f"{chapter}.json"
        self.chapter = chapter
        self._rescue = rescue

    def all(self) -> dict[str, Entry]:
        """Every entry by question id; a file that is damaged or cannot be read counts as none."""
        try:
            return self._read() or {}
        except OSError:
            return {}

    def get(self, id: str) -> Entry:
        """The entry of one question, empty if it has not been answered."""
        return self.all().get(id, {})

    def record(self, id: str, entry: Entry) -> None:
        """Write one entry and count an attempt.

        Raises:
            ResponsesError: if the folder cannot be written.
        """
        self.update(id, lambda before: {**entry, "attempts": attempts(before) + 1})

    def update(self, id: str, change: Callable[[Entry], Entry]) -> Entry:
        """Read an entry, change it and write it: all of it or nothing, even if two kernels do so.

        Raises:
            ResponsesError: if the folder cannot be written.
        """
        try:
            with self._lock():
                entries = self._read()
                if entries is None:
                    self._set_aside()
                if entries is None or not self.path.exists():
                    entries = self._rescue()
                before = entries.get(id, {})
                after = change(dict(before))
                if after == before:
                    return before
                now = datetime.now(UTC).isoformat(timespec="seconds")
                entries[id] = {**after, "answered_at": now}
                self._write(entries)
                return entries[id]
        except (OSError, Timeout) as error:
            what = (
                _("Your response to {question}").format(question=id)
                if id != FILE
                else _("Your name")
            )
            raise ResponsesError(self._refusal(what, error)) from None

    def mend(self) -> str:
        """Put right a damaged or missing file as far as possible, and say what was done.

        Where there was nothing to do it says nothing: the text is empty.

        Raises:
            ResponsesError: if the folder cannot be written.
        """
        try:
            if self._is_sound():
                return ""
            rescued = self._rescue()
            if not self.path.exists() and not rescued:
                return ""
            with self._lock():
                if self._is_sound():  # another kernel was faster
                    return ""
                aside = self._set_aside() if self.path.exists() else None
                self._write(rescued)
        except (OSError, Timeout) as error:
            raise ResponsesError(self._refusal(_("The file of your responses"), error)) from None
        count = len(rescued)
        if aside is None:
            return n_(
                "{file} was missing; {count} answer came back from what the notebook shows. "
                "Look through them.",
                "{file} was missing; {count} answers came back from what the notebook shows. "
                "Look through them.",
                count,
            ).format(file=self.path.name, count=count)
        return n_(
            "{file} was damaged and is kept as {aside}; {count} answer came back from what the "
            "notebook shows. Look through them, and answer again what is missing.",
            "{file} was damaged and is kept as {aside}; {count} answers came back from what the "
            "notebook shows. Look through them, and answer again what is missing.",
            count,
        ).format(file=self.path.name, aside=aside.name, count=count)

    def refusal(self) -> str:
        """Why nothing can be saved here, or an empty string where it can."""
        try:
            with self._lock(), tempfile.TemporaryFile(dir=self.path.parent):
                return ""
        except (OSError, Timeout) as error:
            return self._refusal(_("What you answer here"), error)

    def _refusal(self, what: str, error: Exception) -> str:
        reason = getattr(error, "strerror", None) or _("another program holds it")
        sentence = _(
            "{what} was NOT saved: {folder} cannot be written ({reason}). "
            "Move the course to a folder of your own and answer again."
        )
        return sentence.format(what=what, folder=self.path.parent, reason=reason)

    def _is_sound(self) -> bool:
        return self.path.exists() and self._read() is not None

    def _lock(self) -> FileLock:
        self.path.parent.mkdir(parents=True, exist_ok=True)
        return FileLock(self.path.with_suffix(".lock"), timeout=LOCK_SECONDS)

    def _read(self) -> dict[str, Entry] | None:
        """The entries; None if the file is damaged.

        Raises:
            OSError: if it cannot be read now, as on a network drive: that is no damage.
        """
        try:
            stored = json.loads(self.path.read_text(encoding="utf-8"))
        except FileNotFoundError:
            return {}
        except (ValueError, RecursionError):
            return None
        entries = stored.get("responses") if isinstance(stored, dict) else None
        if isinstance(entries, dict) and all(isinstance(entry, dict) for entry in entries.values()):
            return entries
        return None

    def _set_aside(self) -> Path:
        stamp = datetime.now(UTC).strftime("%Y%m%dT%H%M%S")
        aside = self.path.with_name(f"{self.path.stem}.damaged-{stamp}.json")
        os.replace(self.path, aside)
        return aside

    def _write(self, entries: dict[str, Entry]) -> None:
        text = json.dumps({"chapter": self.chapter, "responses": entries}, indent=1)
        descriptor, unfinished = tempfile.mkstemp(dir=self.path.parent, suffix=".tmp")
        try:
            with open(descriptor, "w", encoding="utf-8", newline="\n") as file:
                file.write(text)
                file.flush()
                os.fsync(descriptor)
            os.replace(unfinished, self.path)
        except BaseException:
            os.unlink(unfinished)
            raise


def attempts(entry: Entry) -> int:
    """How often a question was checked; nonsense in the file counts as never."""
    count = entry.get("attempts", 0)
    return count if isinstance(count, int) and count >= 0 else 0


def answered(entry: Entry | None) -> bool:
    """Whether an entry holds a response."""
    return bool(entry) and (entry or {}).get("status") != "not attempted"


def only_recorded(entry: Entry | None) -> bool:
    """Whether an entry holds a response that is marked later, by the key or by a person."""
    return (entry or {}).get("status") == "recorded"


def points(entry: Entry | None) -> float:
    """The points of an entry; nonsense in the file counts as none."""
    earned = (entry or {}).get("points", 0.0)
    return float(earned) if isinstance(earned, int | float) else 0.0
