"""A control group for each sandbox, where this machine lets its user make one: a third belt.

Limits of processes and the zygote's own look come first, and have the better words. The kernel
counts here what neither sees (its own tables, buffers, many small forks at once), and stops it at
once. Only version 2 is used, and only where memory and processes can both be limited.
"""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from autograder.course import Settings

_PROCESS = Path("/proc/self")
_PREFIX = "autograder-"
_SETTLED = 60.0  # seconds after which a group in use has processes
_WARM_MB = 1024  # for Python, its libraries and what they keep beside a notebook's own memory
BESIDE = 8  # processes: bubblewrap, the zygote, and what is just ending
_NEEDED = {"memory", "pids"}
_ONE_PROCESSOR = "100000 100000"  # microseconds of processor time in each span of as many
_EMPTY_SECONDS = 2.0
# Becomes a member before it becomes the sandbox, so that nothing in there was ever outside.
_JOIN = 'echo 0 > "$0" && exec "$@"'


class ControlGroup:
    """The group of one sandbox; without a ``path`` where this machine has none for us."""

    def __init__(self, settings: Settings) -> None:
        self.path: Path | None = None
        parent = parent_group()
        if parent is None:
            return
        _remove_abandoned(parent)
        with suppress(OSError):
            group = Path(tempfile.mkdtemp(prefix=_PREFIX, dir=parent))
            try:
                _limit(group, settings)
            except OSError:
                group.rmdir()
            else:
                self.path = group

    def joining(self, command: list[str]) -> list[str]:
        """A command as a member of the group."""
        if self.path is None:
            return command
        return ["/bin/sh", "-c", _JOIN, str(self.path / "cgroup.procs"), *command]

    def ended_for_memory(self) -> int:
        """How many processes the kernel has ended in here because memory ran out."""
        return 0 if self.path is None else _field(self.path / "memory.events", "oom_kill")

    def remove(self) -> None:
        """End what is in it and remove it; call it when nobody starts anything there any more."""
        if self.path is None:
            return
        with suppress(OSError):  # Linux 5.14
            (self.path / "cgroup.kill").write_text("1", encoding="ascii")
        deadline = time.monotonic() + _EMPTY_SECONDS
        while self.path.exists() and time.monotonic() < deadline:
            try:
                self.path.rmdir()
            except OSError:  # a process is still on its way out
                time.sleep(0.005)
        self.path = None


def parent_group() -> Path | None:
    """The nearest group above this process in which groups with limits can be made.

    Processes of ours and of others may be in groups below it, but none in it, or the kernel gives
    its groups no limits. The root of all groups alone is free of that rule.
    """
    top = _mounted()
    ours = [g for g in own_groups(top) if os.access(g, os.W_OK)] if top else []
    for group in ours:
        if _words(group / "cgroup.subtree_control") >= _NEEDED:
            return group
    return next(filter(_enable, ours), None)


def _enable(group: Path) -> bool:
    """Let groups below one have limits, if only ourselves are in it, or it is the root of all."""
    is_root = not (group / "cgroup.type").exists()
    if not _words(group / "cgroup.controllers") >= _NEEDED:
        return False
    try:
        if not is_root:
            if _words(group / "cgroup.procs") != {str(os.getpid())}:
                return False
            leaf = group / f"{_PREFIX}itself"
            leaf.mkdir(exist_ok=True)
            (leaf / "cgroup.procs").write_text("0", encoding="ascii")
        wanted = " ".join(f"+{name}" for name in sorted(_NEEDED))
        (group / "cgroup.subtree_control").write_text(wanted, encoding="ascii")
    except OSError:
        return False
    with suppress(OSError):  # it may not be ours to give
        (group / "cgroup.subtree_control").write_text("+cpu", encoding="ascii")
    return True


def own_groups(top: Path, controllers: tuple[str, ...] = ("",)) -> Iterator[Path]:
    """The groups of this process that are below ``top``, and those above each.

    ``controllers`` are those of a tree as the kernel lists them: none for that of version 2.
    """
    with suppress(OSError):
        for line in (_PROCESS / "cgroup").read_text(encoding="utf-8").splitlines():
            _, of_tree, path = line.split(":", 2)
            if of_tree in controllers and ".." not in path:
                group = top / path.strip("/")
                yield from (g for g in (group, *group.parents) if g.is_relative_to(top))


def _mounted() -> Path | None:
    """Where the whole tree of version 2 is mounted."""
    with suppress(OSError):
        for line in (_PROCESS / "mountinfo").read_text(encoding="utf-8").splitlines():
            before, _, after = line.partition(" - ")
            fields = before.split()
            if after.split()[:1] == ["cgroup2"] and fields[3] == "/":
                return Path(fields[4].encode().decode("unicode_escape"))
    return None


def _limit(group: Path, settings: Settings) -> None:
    """Set what a sandbox may have, beyond what its notebooks are allowed one by one.

    Raises:
        OSError: if memory or processes cannot be limited.
    """
    most = settings.memory_mb + settings.files_mb + _WARM_MB
    (group / "memory.max").write_text(str(most * 2**20), encoding="ascii")
    (group / "pids.max").write_text(str(settings.processes + BESIDE), encoding="ascii")
    for name, value in (
        ("memory.swap.max", "0"),
        ("memory.oom.group", "1"),  # all of it ends: what is left would answer for what is not
        ("cpu.max", _ONE_PROCESSOR),
    ):
        with suppress(OSError):  # a kernel without swap, a group without this controller
            if (group / name).exists():
                (group / name).write_text(value, encoding="ascii")


def _remove_abandoned(parent: Path) -> None:
    """Remove the groups that killed graders have left; one with processes cannot be removed."""
    for group in parent.glob(f"{_PREFIX}*"):
        with suppress(OSError):
            if time.time() - group.stat().st_mtime > _SETTLED:
                group.rmdir()


def _words(path: Path) -> set[str]:
    try:
        return set(path.read_text(encoding="ascii").split())
    except OSError:
        return set()


def _field(path: Path, name: str) -> int:
    """A number in a file that has a name and a number in each line; 0 if there is none."""
    with suppress(OSError):
        for line in path.read_text(encoding="ascii").splitlines():
            key, _, value = line.partition(" ")
            if key == name:
                return int(value)
    return 0
