"""Puts what is handed in into an instructor's drop folder, so that no other student reads it.

The folder lets students create files and neither list nor read any (mode 3773, with a group of
instructors): see the page for administrators. The file belongs to the student who makes it, and by
the folder's set-group-id bit to the instructors' group, which may read it; nobody else may.
"""

from __future__ import annotations

import getpass
import os
import secrets
import stat
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path

from autograder.errors import AutograderError
from autograder.intake.drop_folder import name_in_files
from autograder.language import _


def drop(packed: Path, folder: Path) -> Path:
    """Copy a packed submission into the drop folder and return where it is.

    The name holds who hands in, when, and a random part, so that nobody can take it beforehand.

    Raises:
        AutograderError: if it cannot be put there, or other students could read it there.
    """
    if not folder.is_dir():
        raise AutograderError(
            _(
                "{folder} is not a folder, so nothing was handed in; ask your instructor for the "
                "drop folder's path. Your work is packed in {packed}."
            ).format(folder=folder, packed=packed)
        )
    stamp = datetime.now(UTC).strftime("%Y%m%dT%H%M%SZ")
    target = folder / f"{login()}_{stamp}_{secrets.token_hex(4)}.zip"
    unfinished = target.with_suffix(".part")
    try:
        _write(unfinished, packed.read_bytes())
        _keep_from_others(unfinished, folder)
        os.rename(unfinished, target)
    except OSError as error:
        raise AutograderError(
            _(
                "{folder} did not take your work ({reason}), so nothing was handed in; tell your "
                "instructor. It is packed in {packed}."
            ).format(folder=folder, reason=error.strerror or error, packed=packed)
        ) from None
    finally:
        with suppress(OSError):
            unfinished.unlink(missing_ok=True)
    return target


def login() -> str:
    """Who hands in: the user of this process, as the system or a hub calls them."""
    return name_in_files(os.environ.get("JUPYTERHUB_USER") or user_name())


def user_name() -> str:
    """The user of this process: of its id, since the environment may name anybody."""
    try:
        import pwd
    except ImportError:
        return getpass.getuser()  # Windows
    try:
        return pwd.getpwuid(os.getuid()).pw_name
    except KeyError:  # an id without an account, as in a container
        return f"user-{os.getuid()}"


def _write(path: Path, content: bytes) -> None:
    flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)
    with open(os.open(path, flags, 0o600), "wb") as file:
        file.write(content)
        file.flush()
        os.fsync(file.fileno())


def _keep_from_others(path: Path, folder: Path) -> None:
    """Let the folder's group read the file, if it is a group of instructors, and nobody else.

    Raises:
        AutograderError: if the instructors could not read it, or students could.
    """
    if not hasattr(os, "getgroups"):
        return  # Windows: the folder's own access list decides
    here = folder.stat()
    group = path.stat().st_gid
    if group != here.st_gid:
        raise AutograderError(
            _(
                "{folder} does not pass its group on (its set-group-id bit is missing), so your "
                "instructor could not read your work and nothing was handed in. Tell them to run "
                "{command}."
            ).format(folder=folder, command=f"`chmod 3773 {folder}`")
        )
    mine = here.st_uid == os.getuid() or os.getuid() == 0
    if not mine and group in {*os.getgroups(), os.getgid()}:
        raise AutograderError(
            _(
                "You are in the group of {folder}, and so may be all students, who could read "
                "your work there; nothing was handed in. Tell your instructor to give the folder "
                "to a group without students."
            ).format(folder=folder)
        )
    if not mine and here.st_mode & stat.S_IWOTH and not here.st_mode & stat.S_ISVTX:
        raise AutograderError(
            _(
                "In {folder} students could delete what others hand in (its sticky bit is "
                "missing), so nothing was handed in. Tell your instructor to run {command}."
            ).format(folder=folder, command=f"`chmod 3773 {folder}`")
        )
    os.chmod(path, 0o640)
