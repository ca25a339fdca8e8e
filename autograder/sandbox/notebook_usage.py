"""How much memory, disk and how many processes a notebook uses, and whether that is too much."""

from __future__ import annotations

import os
import resource
import stat
from contextlib import suppress
from functools import cache
from pathlib import Path

from autograder.sandbox.processes import all_processes, descendants

_PAGE = resource.getpagesize()
_PIPE = 16 * _PAGE
_FEW = 4  # processes


class Usage:
    """What the processes of one notebook use together, seen from the process that forked them."""

    def __init__(self, work: Path, alone: bool) -> None:
        self._work = work
        self._own = os.getpid()
        self._alone = alone
        self._at_start = _resident(self._own)

    def begin(self, limits: dict[str, int]) -> None:
        """Take new limits: ``memory_mb``, ``processes``, ``files`` and ``files_mb``."""
        self._limits = limits
        self._files_at_start, _ = self._files()

    def excess(self) -> str:
        """Why the notebook must be ended, or an empty text."""
        processes = self.processes()
        if len(processes) > self._limits["processes"] + 2:
            return f"it started more than {self._limits['processes']} processes"
        memory_mb = self._limits["memory_mb"]
        # What a fork shares with its parent is counted twice here, so look twice. What each had at
        # its start is taken off once only: a fork can give it back and fill that room anew.
        own = sum(map(_resident, processes)) - self._at_start
        if own > memory_mb * 2**20:
            exact = sum(_proportional(process) for process in processes)
            if exact > memory_mb * 2**20 + self._at_start:
                return f"it used more than {memory_mb} MB of memory"
        # One process alone may not open as many sockets as that.
        if len(processes) > _FEW and _in_sockets(processes) > memory_mb * 2**20:
            return f"it may hold more than {memory_mb} MB in the buffers of sockets and pipes"
        try:
            files, size = self._files()
        except OSError:
            return "it made folders too deep to look into, or closed them"
        if not self._alone:
            size += _nameless(processes, self._work)
        if files - self._files_at_start > self._limits["files"]:
            return f"it made more than {self._limits['files']} files"
        if size > self._limits["files_mb"] * 2**20:
            return f"it wrote more than {self._limits['files_mb']} MB"
        return ""

    def processes(self) -> list[int]:
        """The processes that there are now."""
        if self._alone:
            return [process for process in all_processes() if process != self._own]
        return descendants(self._own)

    def _files(self) -> tuple[int, int]:
        """How many files there are, and their bytes where the file system does not limit them.

        Raises:
            OSError: if a folder cannot be looked into.
        """
        if self._alone:
            state = os.statvfs(self._work)
            return state.f_files - state.f_ffree, 0
        count = size = 0
        todo = [str(self._work)]  # a list, because folders may be too deep for recursion
        while todo and count <= self._limits["files"]:
            try:
                with os.scandir(todo.pop()) as entries:
                    for entry in entries:
                        count += 1
                        if entry.is_dir(follow_symlinks=False):
                            todo.append(entry.path)
                        else:
                            with suppress(OSError):  # removed meanwhile
                                size += entry.stat(follow_symlinks=False).st_blocks * 512
            except (FileNotFoundError, NotADirectoryError):
                pass  # removed meanwhile
        return count, size


def _nameless(processes: list[int], work: Path) -> int:
    """The bytes of files that were removed but are still open or mapped."""
    sizes: dict[int, int] = {}
    for process in processes:
        with suppress(OSError):
            for descriptor in os.scandir(f"/proc/{process}/fd"):
                with suppress(OSError):
                    found = descriptor.stat()
                    if stat.S_ISREG(found.st_mode) and found.st_nlink == 0:
                        sizes[found.st_ino] = found.st_blocks * 512
        with suppress(OSError):
            for line in Path(f"/proc/{process}/maps").read_bytes().splitlines():
                if line.endswith(b" (deleted)") and os.fsencode(work) in line:
                    addresses, _, _, _, inode, *_ = line.split()
                    start, _, end = addresses.partition(b"-")
                    sizes.setdefault(int(inode), int(end, 16) - int(start, 16))
    return sum(sizes.values())


def _in_sockets(processes: list[int]) -> int:
    """The most that the sockets and pipes of these processes hold, which no count of theirs shows.

    The kernel lets a socket's owner raise its buffer to twice the limit; pipes are far smaller.
    """
    seen: set[str] = set()
    for process in processes:
        with suppress(OSError):
            for descriptor in os.scandir(f"/proc/{process}/fd"):
                with suppress(OSError):
                    seen.add(os.readlink(descriptor.path))
    sockets = sum(name.startswith("socket:") for name in seen)
    pipes = sum(name.startswith("pipe:") for name in seen)
    return sockets * 2 * _most_of_a_socket() + pipes * _PIPE


@cache
def _most_of_a_socket() -> int:
    try:
        return int(Path("/proc/sys/net/core/wmem_max").read_text(encoding="utf-8"))
    except (OSError, ValueError):  # in a list of processes of its own it may be hidden
        return 212_992


def _resident(process: int) -> int:
    try:
        return int(Path(f"/proc/{process}/statm").read_text(encoding="utf-8").split()[1]) * _PAGE
    except (OSError, IndexError, ValueError):
        return 0


def _proportional(process: int) -> int:
    """Memory with shared pages divided among those who share them."""
    try:
        lines = Path(f"/proc/{process}/smaps_rollup").read_text(encoding="utf-8").splitlines()
        return next(int(line.split()[1]) * 1024 for line in lines if line.startswith("Pss:"))
    except (OSError, StopIteration, ValueError, IndexError):
        return _resident(process)
