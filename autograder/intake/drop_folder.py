"""Collects what students have put into a drop folder: the newest of each, with its time.

Everything in it was written by students. Who handed a file in is who owns it, not what its name
says; when, is the time of its last change as the system keeps it, which no student can set back.
"""

from __future__ import annotations

import csv
import hashlib
import io
import os
import re
import stat
import unicodedata
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from urllib.parse import quote, unquote

from autograder.errors import UsageError

TIMES = "times.csv"
_LONGEST_ACCOUNT = 26  # characters, as The Littlest JupyterHub has it


@dataclass(frozen=True)
class Dropped:
    """One file that was handed in."""

    login: str
    name: str
    content: bytes = field(repr=False)
    time: datetime


@dataclass(frozen=True)
class Collected:
    """The newest of each, how many earlier ones there were, and what was not taken and why."""

    newest: tuple[Dropped, ...]
    earlier: int
    left: tuple[str, ...]


def collect(folder: Path, most: int, trust_names: bool = False) -> Collected:
    """Read a drop folder; a file in it may be anything.

    Args:
        folder: where `submit(to=...)` puts files ``LOGIN_TIME_RANDOM.zip``.
        most: the bytes that one file may have.
        trust_names: take the login of the name where all files have one owner, as on a hub that
            runs every student as the same user.

    Raises:
        UsageError: if the folder cannot be read.
    """
    try:
        names = sorted(os.listdir(folder))
    except OSError as error:
        raise UsageError(f"{folder} cannot be read: {error.strerror or error}.") from None
    taken: list[Dropped] = []
    left: list[str] = []
    shared = _have_one_owner(folder, names)
    for name in names:
        if name.endswith(".part"):
            left.append(f"{name}: it was not finished; collect again in a minute")
            continue
        try:
            taken.append(_take(folder / name, most, trust_names, shared))
        except (UsageError, OSError) as error:
            left.append(f"{name}: {getattr(error, 'strerror', None) or error}")
    newest: dict[str, Dropped] = {}
    for entry in sorted(taken, key=lambda entry: (entry.time, entry.name)):
        newest[entry.login] = entry
    kept = tuple(newest[login] for login in sorted(newest))
    return Collected(kept, len(taken) - len(kept), tuple(left))


def name_in_files(login: str) -> str:
    """A login as the name of a file holds it: different logins have different names."""
    login = unicodedata.normalize("NFC", login)
    safe = re.sub(r"[^\w.@+-]", lambda sign: quote(sign[0], "", errors="replace"), login)
    return safe.replace(".", "%2E", 1) if safe.startswith(".") else safe


def _have_one_owner(folder: Path, names: list[str]) -> bool:
    """Whether all files are one user's: then it may be a hub's that runs everybody."""
    owners = set()
    for name in names:
        with suppress(OSError):
            owners.add((folder / name).lstat().st_uid)
    return len(owners) == 1


def _take(path: Path, most: int, trust_names: bool, shared: bool) -> Dropped:
    # Neither a link to somebody else's file nor a pipe that nobody ever writes to is followed.
    flags = os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
    if path.is_symlink():
        raise UsageError("it is a link")
    with open(os.open(path, flags | getattr(os, "O_BINARY", 0)), "rb") as file:
        found = os.fstat(file.fileno())
        if not stat.S_ISREG(found.st_mode):
            raise UsageError("it is not a file")
        if found.st_nlink != 1:
            raise UsageError("it has a second name, so it may be another student's")
        if found.st_size > most:
            raise UsageError(f"it is larger than {most // 2**20} MB")
        content = file.read(most + 1)
    if path.suffix != ".zip" or len(content) > most:
        raise UsageError("it was not made by submit()")
    login = path.stem.rsplit("_", 2)[0]
    if not login or name_in_files(unquote(login)) != login:
        raise UsageError("it was not made by submit()")
    owner = _owner(found.st_uid)
    if owner is not None and owner not in _accounts(login) and not trust_names:
        advice = f"; if your hub runs everybody as {owner}, collect with --trust-names"
        raise UsageError(f"it is called {login}'s and belongs to {owner}{advice if shared else ''}")
    return Dropped(login, path.name, content, datetime.fromtimestamp(found.st_ctime, UTC))


def _accounts(login: str) -> tuple[str, str]:
    """The system's accounts that a login may have: its own, or the one of a hub that makes them.

    The Littlest JupyterHub calls them so, with the beginning and a hash of one that is long.
    """
    made = f"jupyter-{unquote(login)}"
    if len(made) >= _LONGEST_ACCOUNT:
        made = f"{made[:_LONGEST_ACCOUNT]}-{hashlib.sha256(made.encode()).hexdigest()[:5]}"
    return login, name_in_files(made)


def _owner(user: int) -> str | None:
    """The login of a file's owner as `submit` writes it; None where files have none (Windows)."""
    try:
        import pwd
    except ImportError:
        return None
    try:
        return name_in_files(pwd.getpwuid(user).pw_name)
    except KeyError:
        return f"user-{user}"


def write_class(collected: Collected, folder: Path) -> Iterator[str]:
    """Write one zip a login and ``times.csv``, as ``grade`` reads them; yield what is new.

    A folder that is made here is its owner's alone. What was collected before and has been taken
    out of the drop folder since then stays, with its time.

    Raises:
        OSError: if the folder cannot be written.
    """
    folder.mkdir(0o700, parents=True, exist_ok=True)
    for entry in collected.newest:
        target = folder / f"{entry.login}.zip"
        if not target.exists() or target.read_bytes() != entry.content:
            unfinished = folder / f".{entry.login}.part"
            unfinished.write_bytes(entry.content)
            os.replace(unfinished, target)
            yield entry.login
    times = withdrawn(collected, folder)
    for entry in collected.newest:
        times[f"{entry.login}.zip"] = entry.time.isoformat(timespec="seconds")
    table = io.StringIO()
    rows = csv.writer(table, lineterminator="\n")
    rows.writerow(("file", "time"))
    rows.writerows(sorted(times.items()))
    (folder / TIMES).write_text(table.getvalue(), encoding="utf-8", newline="\n")


def withdrawn(collected: Collected, folder: Path) -> dict[str, str]:
    """The times, by file, of what was collected before and is in the drop folder no more."""
    try:
        with (folder / TIMES).open(encoding="utf-8", newline="") as file:
            known = {row["file"]: row["time"] for row in csv.DictReader(file)}
    except (OSError, ValueError, KeyError, csv.Error):
        return {}
    there = {f"{entry.login}.zip" for entry in collected.newest}
    return {
        name: time
        for name, time in known.items()
        if name and time and name not in there and (folder / name).is_file()
    }
