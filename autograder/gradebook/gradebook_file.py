"""The gradebook's file: every write is one transaction, and settings are kept by name."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Self

from autograder.gradebook.schema import connect
from autograder.gradebook.unusable_gradebook import readable_errors


class GradebookFile:
    """An open gradebook; readers may look on while somebody writes."""

    def __init__(self, path: Path, create: bool = True) -> None:
        """Open the gradebook, or begin one.

        Raises:
            GradebookError: if the file is damaged, something else or from a newer version, or if it
                is missing and ``create`` is false.
        """
        self.path = path
        self._db = connect(path, create)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    def close(self) -> None:
        """Close the file."""
        self._db.close()

    @contextmanager
    def _transaction(self) -> Iterator[sqlite3.Connection]:
        with readable_errors(self.path):
            self._db.execute("BEGIN IMMEDIATE")
            try:
                yield self._db
            except BaseException:
                self._db.execute("ROLLBACK")
                raise
            self._db.execute("COMMIT")

    def _rows(self, query: str, values: tuple[object, ...] = ()) -> list[Any]:
        with readable_errors(self.path):
            return self._db.execute(query, values).fetchall()

    def students(self) -> list[str]:
        """The keys of all students, in their order."""
        return [row[0] for row in self._rows("SELECT student FROM submission ORDER BY student")]

    def setting(self, name: str) -> str | None:
        """What was set under a name, None if nothing was."""
        rows = self._rows("SELECT value FROM setting WHERE name = ?", (name,))
        return rows[0][0] if rows else None

    def set(self, name: str, value: str) -> None:
        """Keep a setting."""
        with self._transaction() as db:
            db.execute("INSERT OR REPLACE INTO setting VALUES (?, ?)", (name, value))


def now_text() -> str:
    """The time as the gradebook keeps it: UTC, ISO 8601."""
    return datetime.now(UTC).isoformat(timespec="seconds")
