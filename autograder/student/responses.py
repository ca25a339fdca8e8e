"""Responses kept beside the notebooks, a JSON file a chapter: the truth about what was answered."""

from __future__ import annotations

import json
import os
import tempfile
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from filelock import FileLock, Timeout

from autograder.errors import AutograderError

LOCK_SECONDS = 10.0


class ResponsesError(AutograderError):
    """A response could not be kept."""


def responses_folder(course_root: Path) -> Path:
    """The folder ``responses`` beside the notebook that is running.

    A notebook's kernel runs in the notebook's folder. Anywhere else it is the folder beside the
    course's notebooks. The environment variable ``AUTOGRADER_RESPONSES`` names another one.
    """
    given = os.environ.get("AUTOGRADER_RESPONSES")
    if given:
        return Path(given)
    here = Path.cwd()
    beside = here if any(here.glob("*.ipynb")) else course_root / "notebooks"
    return beside / "responses"


class Responses:
    """The responses to one chapter's questions."""

    def __init__(self, folder: Path, chapter: str) -> None:
        self.path = folder / f"{chapter}.json"
        self.chapter = chapter

    def all(self) -> dict[str, dict[str, Any]]:
        """Every entry by question id; a damaged file counts as none and is left for `record`."""
        return self._read() or {}

    def get(self, id: str) -> dict[str, Any]:
        """The entry of one question, empty if it has not been answered."""
        return self.all().get(id, {})

    def record(self, id: str, entry: dict[str, Any]) -> None:
        """Write one entry: all of it or nothing, even if two notebooks write at once.

        A damaged file is kept aside under another name.

        Raises:
            ResponsesError: if the folder cannot be written.
        """
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            with FileLock(self.path.with_suffix(".lock"), timeout=LOCK_SECONDS):
                entries = self._read()
                if entries is None:
                    self._set_aside()
                    entries = {}
                attempts = entries.get(id, {}).get("attempts", 0)
                attempts = attempts + 1 if isinstance(attempts, int) else 1
                answered_at = datetime.now(UTC).isoformat(timespec="seconds")
                entries[id] = {**entry, "attempts": attempts, "answered_at": answered_at}
                self._write(entries)
        except (OSError, Timeout) as error:
            raise ResponsesError(
                f"Your response to {id} was NOT saved: {self.path.parent} cannot be written "
                f"({error}). Move the course to a folder of your own and answer again."
            ) from None

    def _read(self) -> dict[str, dict[str, Any]] | None:
        """The entries; None if the file is damaged."""
        try:
            stored = json.loads(self.path.read_text(encoding="utf-8"))
        except FileNotFoundError:
            return {}
        except (ValueError, OSError, RecursionError):
            return None
        entries = stored.get("responses") if isinstance(stored, dict) else None
        if isinstance(entries, dict) and all(isinstance(entry, dict) for entry in entries.values()):
            return entries
        return None

    def _set_aside(self) -> None:
        stamp = datetime.now(UTC).strftime("%Y%m%dT%H%M%S")
        aside = self.path.with_name(f"{self.path.stem}.damaged-{stamp}.json")
        os.replace(self.path, aside)
        print(f"{self.path.name} was damaged; it is kept as {aside.name}, and a new one is begun.")

    def _write(self, entries: dict[str, dict[str, Any]]) -> None:
        text = json.dumps({"chapter": self.chapter, "responses": entries}, indent=1)
        descriptor, unfinished = tempfile.mkstemp(dir=self.path.parent, suffix=".tmp")
        try:
            with open(descriptor, "w", encoding="utf-8") as file:
                file.write(text)
                file.flush()
                os.fsync(descriptor)
            os.replace(unfinished, self.path)
        except BaseException:
            os.unlink(unfinished)
            raise
