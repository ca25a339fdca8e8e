"""The gradebook's tables, its versions, and opening the file without ever harming it."""

from __future__ import annotations

import sqlite3
from pathlib import Path
from urllib.parse import quote

from autograder.errors import refuse_link
from autograder.gradebook.unusable_gradebook import GradebookError, readable_errors

BUSY_SECONDS = 30.0  # how long a writer waits for another one

# One step for each version: a new file takes all of them, an old one those that it lacks.
_STEPS = (
    """
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
""",
    """
-- NULL if it was stopped
ALTER TABLE run ADD COLUMN finished_at TEXT;
ALTER TABLE run ADD COLUMN seconds REAL NOT NULL DEFAULT 0;
-- how long running and marking it took
ALTER TABLE submission ADD COLUMN seconds REAL NOT NULL DEFAULT 0;
-- UTC, ISO 8601
ALTER TABLE submission ADD COLUMN handed_in TEXT;
ALTER TABLE submission ADD COLUMN late_days INTEGER NOT NULL DEFAULT 0;
ALTER TABLE submission ADD COLUMN late_percent REAL NOT NULL DEFAULT 0;
CREATE TABLE override (            -- the latest for a student and a question counts
    id INTEGER PRIMARY KEY,
    student TEXT NOT NULL,
    question TEXT NOT NULL,
    points REAL,                   -- NULL withdraws the one before
    reason TEXT NOT NULL,
    made_at TEXT NOT NULL
) STRICT;
CREATE TABLE note (
    id INTEGER PRIMARY KEY,
    student TEXT NOT NULL,
    text TEXT NOT NULL,
    made_at TEXT NOT NULL
) STRICT;
CREATE TABLE setting (name TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT;
""",
    """
-- JSON, as Origin.to_dict: layout, whose it says it is, when it was handed in, its pieces
ALTER TABLE submission ADD COLUMN origin TEXT NOT NULL DEFAULT '{}';
""",
    """
-- who gave the points
ALTER TABLE override ADD COLUMN author TEXT NOT NULL DEFAULT '';
-- JSON, the level reached in each criterion of a rubric
ALTER TABLE override ADD COLUMN levels TEXT NOT NULL DEFAULT '{}';
-- digest of the response that was marked, empty where the points hold whatever is handed in
ALTER TABLE override ADD COLUMN response TEXT NOT NULL DEFAULT '';
-- 1 if it came from another gradebook and contradicts the one before: neither counts
ALTER TABLE override ADD COLUMN disputed INTEGER NOT NULL DEFAULT 0;
ALTER TABLE note ADD COLUMN author TEXT NOT NULL DEFAULT '';
CREATE TABLE attempt (             -- what a student had handed in before the submission of now
    id INTEGER PRIMARY KEY,
    student TEXT NOT NULL,
    fingerprint TEXT NOT NULL,
    run INTEGER NOT NULL REFERENCES run(id),
    marks TEXT NOT NULL,           -- JSON list of Mark.to_dict
    handed_in TEXT,
    late_days INTEGER NOT NULL,
    late_percent REAL NOT NULL,
    replaced_at TEXT NOT NULL      -- UTC, ISO 8601
) STRICT;
""",
    """
-- JSON: what the student predicted, by id
ALTER TABLE submission ADD COLUMN predictions TEXT NOT NULL DEFAULT '{}';
""",
    """
-- whose numbers it was marked by, empty where everybody has the sheet's
ALTER TABLE submission ADD COLUMN numbers_of TEXT NOT NULL DEFAULT '';
""",
    """
-- what kept its code in where it was graded; empty in older gradebooks, where the run's is known
ALTER TABLE submission ADD COLUMN isolation TEXT NOT NULL DEFAULT '';
""",
)
SCHEMA_VERSION = len(_STEPS)


def connect(path: Path, create: bool) -> sqlite3.Connection:
    """Open the file, begin it if ``create`` says so, and bring an older one up to date.

    Raises:
        GradebookError: if it is missing, damaged, something else, or from a newer version.
    """
    if not path.exists() and not create:
        raise GradebookError(
            f"There is no gradebook at {path}; run `autograder grade` first, or name its folder "
            "with --out."
        )
    for name in ("", "-wal", "-shm", "-journal"):
        refuse_link(path.with_name(path.name + name))
    with readable_errors(path):
        path.parent.mkdir(0o700, parents=True, exist_ok=True)  # others read no grades
        mode = "rwc" if create else "rw"
        db = sqlite3.connect(
            f"file:{quote(str(path.absolute()))}?mode={mode}",
            uri=True,
            timeout=BUSY_SECONDS,
            isolation_level=None,
        )
        try:
            version = _version(db, path)
            if version == SCHEMA_VERSION:
                trouble = db.execute("PRAGMA quick_check(1)").fetchone()[0]
                if trouble != "ok":
                    raise sqlite3.DatabaseError(trouble)
            else:
                _bring_up_to_date(db, path)
            db.execute("PRAGMA foreign_keys = ON")
        except BaseException:
            db.close()
            raise
    return db


def _version(db: sqlite3.Connection, path: Path) -> int:
    version = int(db.execute("PRAGMA user_version").fetchone()[0])
    tables = db.execute("SELECT count(*) FROM sqlite_schema").fetchone()[0]
    if version == 0 and tables:
        raise GradebookError(
            f"{path} is a database, but not a gradebook; move it away or choose another --out."
        )
    if version > SCHEMA_VERSION:
        raise GradebookError(
            f"{path} has schema {version}, this autograder knows {SCHEMA_VERSION}; "
            "use the version that wrote it, or choose another --out."
        )
    return version


def _bring_up_to_date(db: sqlite3.Connection, path: Path) -> None:
    db.execute("PRAGMA journal_mode = WAL")  # readers look on while grading writes
    db.execute("BEGIN IMMEDIATE")
    try:
        # Again, under the lock: two graders may begin the same file at once.
        for step in _STEPS[_version(db, path) :]:
            for statement in step.split(";\n"):
                if statement.strip():
                    db.execute(statement)
        db.execute(f"PRAGMA user_version = {SCHEMA_VERSION}")
    except BaseException:
        db.execute("ROLLBACK")
        raise
    db.execute("COMMIT")
