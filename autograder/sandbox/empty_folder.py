"""Empties a folder, however what filled it made that hard.

Folders in each other, which may be too many for recursion and their path too long to name, are
moved up level by level; those that refuse are opened; links are never followed.
"""

from __future__ import annotations

import os
import secrets
import shutil
import stat
import sys
import time
from contextlib import suppress
from itertools import count
from pathlib import Path

_SECONDS = 30.0


def remove(folder: Path) -> None:
    """Remove a folder with all that is in it, as far as that is possible."""
    if sys.platform == "win32":
        shutil.rmtree(folder, ignore_errors=True)
        return
    with suppress(OSError):
        empty(folder)
        folder.rmdir()


def empty(folder: Path) -> None:
    """Remove everything in a folder.

    Raises:
        OSError: if something is left, or if somebody goes on filling it.
    """
    deadline = time.monotonic() + _SECONDS
    prefix, numbers = secrets.token_hex(8), count()
    top = _open(str(folder), None)
    try:
        while names := os.listdir(top):
            for name in names:
                if time.monotonic() > deadline:
                    raise OSError(f"{folder} cannot be emptied")
                if _unlink(name, top):
                    continue
                inside = _open(name, top)
                try:
                    for inner in os.listdir(inside):
                        if not _unlink(inner, inside):
                            _make_writable(inner, inside)  # or it could not be moved
                            new_name = f"{prefix}-{next(numbers)}"
                            os.rename(inner, new_name, src_dir_fd=inside, dst_dir_fd=top)
                finally:
                    os.close(inside)
                os.rmdir(name, dir_fd=top)
    finally:
        os.close(top)


def _unlink(name: str, beside: int) -> bool:
    """Remove a file or a link; False if it is a folder."""
    if stat.S_ISDIR(os.lstat(name, dir_fd=beside).st_mode):
        return False
    os.unlink(name, dir_fd=beside)
    return True


def _open(name: str, beside: int | None) -> int:
    _make_writable(name, beside)
    flags = os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC
    return os.open(name, flags, dir_fd=beside)


def _make_writable(name: str, beside: int | None) -> None:
    """Give a folder's owner every right to it, but to nothing that was put in its place."""
    if os.lstat(name, dir_fd=beside).st_mode & 0o700 == 0o700:
        return
    if sys.platform != "linux":
        os.chmod(name, 0o700, dir_fd=beside, follow_symlinks=False)
        return
    flags = os.O_PATH | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC
    folder = os.open(name, flags, dir_fd=beside)
    try:
        os.chmod(f"/proc/self/fd/{folder}", 0o700)
    finally:
        os.close(folder)
