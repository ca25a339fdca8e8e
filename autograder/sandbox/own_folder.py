"""A temporary folder that is removed in the end, even if the process that made it is killed.

As long as its process lives, it holds a lock on a file in the folder. Whoever makes the next one
removes the folders whose lock nobody holds any more.
"""

from __future__ import annotations

import os
import tempfile
import time
from contextlib import suppress
from pathlib import Path

from autograder.sandbox.empty_folder import remove

try:
    import fcntl
except ImportError:  # Windows: a killed process leaves its folder to the system
    fcntl = None  # type: ignore[assignment]

_PREFIX = "autograder-"
_LOCK = ".in-use-by-autograder"
_SETTLED = 60.0  # seconds after which a folder has its lock, if its process lives


class OwnFolder:
    """A new empty folder; `remove` it, or use it as a context manager."""

    def __init__(self) -> None:
        _remove_abandoned()
        self.path = Path(tempfile.mkdtemp(prefix=_PREFIX))
        self._lock = os.open(self.path / _LOCK, os.O_CREAT | os.O_RDWR | os.O_CLOEXEC, 0o600)
        if fcntl is not None:
            fcntl.flock(self._lock, fcntl.LOCK_EX)

    def __enter__(self) -> Path:
        return self.path

    def __exit__(self, *exception: object) -> None:
        self.remove()

    def remove(self) -> None:
        """Remove the folder with all that is in it."""
        if self._lock >= 0:
            os.close(self._lock)
            self._lock = -1
        remove(self.path)


def _remove_abandoned() -> None:
    if fcntl is None:
        return
    for entry in os.scandir(tempfile.gettempdir()):
        if entry.name.startswith(_PREFIX) and entry.is_dir(follow_symlinks=False):
            with suppress(OSError):  # somebody else's, or still in use
                _remove_if_abandoned(Path(entry.path))


def _remove_if_abandoned(folder: Path) -> None:
    lock = os.open(folder / _LOCK, os.O_RDWR | os.O_NOFOLLOW | os.O_CLOEXEC)
    try:
        settled = time.time() - os.fstat(lock).st_mtime > _SETTLED
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        if settled:
            remove(folder)
    finally:
        os.close(lock)
