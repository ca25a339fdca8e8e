"""What is said of a gradebook that cannot be read or written; it is never overwritten."""

from __future__ import annotations

import errno
import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from autograder.errors import AutograderError, machine_error, short_of


class GradebookError(AutograderError):
    """The gradebook cannot be read or written; it is never overwritten."""


@contextmanager
def readable_errors(path: Path) -> Iterator[None]:
    """Say in one sentence what SQLite or the system reports."""
    try:
        yield
    except sqlite3.OperationalError as error:
        if error.sqlite_errorcode == sqlite3.SQLITE_FULL:
            raise short_of(errno.ENOSPC, str(path)) or error from None
        if error.sqlite_errorcode == sqlite3.SQLITE_NOMEM:
            raise short_of(errno.ENOMEM) or error from None
        if error.sqlite_errorcode == sqlite3.SQLITE_ERROR:
            raise GradebookError(
                f"{path} cannot be read as a gradebook: its tables are not those of the "
                f"schema that it names ({error}); restore it from a copy, or move it away and "
                "grade again."
            ) from None
        raise GradebookError(
            f"{path} cannot be used now ({error}); if another autograder is writing there, wait "
            "for it, otherwise check the disk and the folder's permissions."
        ) from None
    except sqlite3.DatabaseError as error:
        raise GradebookError(
            f"{path} cannot be read as a gradebook ({error}); "
            "restore it from a copy, or move it away and grade again."
        ) from None
    except OSError as error:
        if (short := machine_error(error, str(path))) is not None:
            raise short from None
        raise GradebookError(
            f"{path} cannot be written ({error}); choose another folder with --out."
        ) from None


@contextmanager
def readable_entries(path: Path) -> Iterator[None]:
    """Say in one sentence that what stands in a table is not what was written there."""
    try:
        yield
    except (ValueError, TypeError, LookupError, AttributeError, RecursionError) as error:
        raise GradebookError(
            f"{path} holds an entry that cannot be read ({error}); restore it from a copy, or move "
            "it away and grade again."
        ) from None
