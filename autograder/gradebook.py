"""The gradebook: one SQLite file with the runs, the submissions and their marks."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from autograder.errors import AutograderError
from autograder.grading import Graded
from autograder.marking import Mark
from autograder.submissions import Submission

SCHEMA_VERSION = 1
_SCHEMA = """
CREATE TABLE run (
    id INTEGER PRIMARY KEY,
    course_version TEXT NOT NULL,  -- fingerprint of questions, answers and references
    seed INTEGER NOT NULL,         -- draws the hidden inputs again
    isolation TEXT NOT NULL,       -- what kept student code in
    started_at TEXT NOT NULL       -- UTC, ISO 8601
) STRICT;
CREATE TABLE submission (
    student TEXT PRIMARY KEY,
    path TEXT NOT NULL,
    fingerprint TEXT NOT NULL,     -- hash of what was handed in, empty if unreadable
    status TEXT NOT NULL,          -- graded or unreadable
    notes TEXT NOT NULL,           -- JSON list: what was odd about the files
    run INTEGER NOT NULL REFERENCES run(id)
) STRICT;
CREATE TABLE mark (
    student TEXT NOT NULL REFERENCES submission(student) ON DELETE CASCADE,
    question TEXT NOT NULL,
    run INTEGER NOT NULL REFERENCES run(id),
    mark TEXT NOT NULL,            -- JSON, as Mark.to_dict
    PRIMARY KEY (student, question)
) STRICT;
"""


class GradebookError(AutograderError):
    """The gradebook cannot be read; it is never overwritten."""


@dataclass(frozen=True)
class Run:
    """One run of the grader: the key and the seed that decide the marks."""

    id: int
    course_version: str
    seed: int


class Gradebook:
    """Submissions and marks; every write is one transaction, readers may look on meanwhile."""

    def __init__(self, path: Path) -> None:
        """Open the gradebook, or begin one.

        Raises:
            GradebookError: if the file is damaged or from a newer version.
        """
        self.path = path
        path.parent.mkdir(parents=True, exist_ok=True)
        self._db = sqlite3.connect(path, isolation_level=None)
        try:
            version = self._db.execute("PRAGMA user_version").fetchone()[0]
            tables = self._db.execute("SELECT count(*) FROM sqlite_schema").fetchone()[0]
            if version == 0 and tables == 0:
                self._db.execute("PRAGMA journal_mode = WAL")
                with self._transaction():
                    for statement in _SCHEMA.split(";\n"):
                        if statement.strip():
                            self._db.execute(statement)
                    self._db.execute(f"PRAGMA user_version = {SCHEMA_VERSION}")
            elif version != SCHEMA_VERSION:
                raise GradebookError(
                    f"{path} has schema {version}, this autograder knows {SCHEMA_VERSION}; "
                    "use the version that wrote it, or choose another --out."
                )
            self._db.execute("PRAGMA foreign_keys = ON")
        except sqlite3.DatabaseError as error:
            raise GradebookError(
                f"{path} cannot be read as a gradebook ({error}); "
                "restore it from a copy, or move it away and grade again."
            ) from None

    def close(self) -> None:
        """Close the file."""
        self._db.close()

    @contextmanager
    def _transaction(self) -> Iterator[None]:
        self._db.execute("BEGIN IMMEDIATE")
        try:
            yield
        except BaseException:
            self._db.execute("ROLLBACK")
            raise
        self._db.execute("COMMIT")

    def last_run(self) -> Run | None:
        """The latest run, if there was one."""
        row = self._db.execute(
            "SELECT id, course_version, seed FROM run ORDER BY id DESC LIMIT 1"
        ).fetchone()
        return Run(*row) if row else None

    def begin_run(self, course_version: str, seed: int, isolation: str) -> Run:
        """Note a new run."""
        started = datetime.now(UTC).isoformat(timespec="seconds")
        with self._transaction():
            cursor = self._db.execute(
                "INSERT INTO run (course_version, seed, isolation, started_at) VALUES (?, ?, ?, ?)",
                (course_version, seed, isolation, started),
            )
        assert cursor.lastrowid is not None
        return Run(cursor.lastrowid, course_version, seed)

    def store(self, graded: Graded, run: Run) -> None:
        """Write one submission and its marks, all or nothing.

        Marks of questions that were not graded this time stay.
        """
        with self._transaction():
            self._db.execute(
                "INSERT INTO submission VALUES (?, ?, ?, ?, ?, ?) ON CONFLICT (student) DO UPDATE "
                "SET path = excluded.path, fingerprint = excluded.fingerprint, "
                "status = excluded.status, notes = excluded.notes, run = excluded.run",
                (
                    graded.submission.student,
                    str(graded.submission.path),
                    graded.fingerprint,
                    graded.status,
                    json.dumps(graded.notes),
                    run.id,
                ),
            )
            self._db.executemany(
                "INSERT OR REPLACE INTO mark VALUES (?, ?, ?, ?)",
                [
                    (graded.submission.student, m.question, run.id, json.dumps(m.to_dict()))
                    for m in graded.marks
                ],
            )

    def find(self, student: str, fingerprint: str, run: Run) -> Graded | None:
        """What was graded before, if the same work was graded in the same run."""
        row = self._db.execute(
            "SELECT path, status, notes FROM submission "
            "WHERE student = ? AND fingerprint = ? AND run = ? AND status = 'graded'",
            (student, fingerprint, run.id),
        ).fetchone()
        if row is None:
            return None
        path, status, notes = row
        submission = Submission(student, Path(path))
        return Graded(
            submission, status, fingerprint, self._marks(student), tuple(json.loads(notes))
        )

    def all(self) -> list[Graded]:
        """Every submission with its marks, by student."""
        rows = self._db.execute(
            "SELECT student, path, fingerprint, status, notes FROM submission ORDER BY student"
        ).fetchall()
        return [
            Graded(
                Submission(student, Path(path)),
                status,
                fingerprint,
                self._marks(student),
                tuple(json.loads(notes)),
            )
            for student, path, fingerprint, status, notes in rows
        ]

    def _marks(self, student: str) -> tuple[Mark, ...]:
        rows = self._db.execute(
            "SELECT mark FROM mark WHERE student = ? ORDER BY rowid", (student,)
        ).fetchall()
        return tuple(Mark.from_dict(json.loads(text)) for (text,) in rows)
