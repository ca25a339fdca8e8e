"""The processes that student code leaves behind, and how much they use together."""

from __future__ import annotations

import os
import resource
import signal
import stat
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import cache
from pathlib import Path

_PAGE = resource.getpagesize()
_PIPE = 16 * _PAGE
_SWEEP_SECONDS = 5.0
_EXIT_SECONDS = 1.0  # for a process that has no more to do than to give its memory back
_FEW = 4  # processes


def end_all_others(everything: bool) -> None:
    """End all processes that came from this one.

    With ``everything``, whatever this process may signal: right where it is alone in a list of
    processes or has a user id that nobody else has. Otherwise its descendants, which it adopts when
    their parents end.
    """
    deadline = time.monotonic() + _SWEEP_SECONDS
    while time.monotonic() < deadline:
        if everything:
            with suppress(ProcessLookupError, PermissionError):
                os.kill(-1, signal.SIGKILL)
        else:
            for process in descendants(os.getpid()):
                with suppress(ProcessLookupError, PermissionError):
                    os.kill(process, signal.SIGKILL)
        if not _collect():
            return
    raise OSError("some processes cannot be ended")


def end_leftovers(
    child: int, processes: Callable[[], list[int]], only_orphans: bool = False
) -> None:
    """End all of some processes but one child of this one; those that are left after a while stay.

    Mostly there are none, which the kernel says at once where it lists a process's children. With
    ``only_orphans`` the child's own are waited for and spared: one of them may have sent its answer
    and be about to end.
    """
    deadline = time.monotonic() + _EXIT_SECONDS
    while only_orphans and _has_children(child) and time.monotonic() < deadline:
        time.sleep(0.001)
    deadline = time.monotonic() + _SWEEP_SECONDS
    while not _has_no_others(child) and time.monotonic() < deadline:
        spared = {1, child, *(descendants(child) if only_orphans else ())}
        others = [p for p in processes() if p not in spared and not _has_ended(p)]
        for number in (signal.SIGSTOP, signal.SIGKILL):  # what is stopped forks no more
            for process in others:
                with suppress(ProcessLookupError, PermissionError):
                    os.kill(process, number)
        for process in others:
            # Those whose parents have ended are children of this process, and to be waited for.
            with suppress(ChildProcessError):
                os.waitpid(process, os.WNOHANG)
        if not others:
            return


def _has_ended(process: int) -> bool:
    """Whether it waits only for its parent to ask how it ended."""
    try:
        return stat_fields(process)[0] == b"Z"
    except (OSError, IndexError):
        return True


def _has_children(process: int) -> bool:
    try:
        return bool(_children(process))
    except (OSError, ValueError):
        return False


def _has_no_others(child: int) -> bool:
    """Whether a child has no children, and this process no other child."""
    try:
        if _children(os.getpid()) - {child}:
            return False
        return not _children(child)
    except (OSError, ValueError):  # the kernel keeps no such lists, or the child has ended
        return False


def _children(process: int) -> set[int]:
    """The children of all threads of a process."""
    tasks = Path(f"/proc/{process}/task")
    return {
        int(child)
        for task in os.listdir(tasks)
        for child in (tasks / task / "children").read_text(encoding="ascii").split()
    }


def _collect() -> bool:
    """Wait for an ended child; whether there is any child left."""
    try:
        os.waitpid(-1, 0)
        while os.waitpid(-1, os.WNOHANG)[0]:
            pass
    except ChildProcessError:
        return False
    return True


def stat_fields(process: int) -> list[bytes]:
    """What the kernel says of a process, from its state on, behind its name.

    Bytes, because a process may name itself by any: one whose name is no text must not be missed.

    Raises:
        OSError: if it has ended.
    """
    return Path(f"/proc/{process}/stat").read_bytes().rpartition(b")")[2].split()


def descendants(ancestor: int) -> list[int]:
    """Every process below one, by the parent that each names."""
    children: dict[int, list[int]] = {}
    for process in all_processes():
        with suppress(OSError, ValueError, IndexError):
            fields = stat_fields(process)
            children.setdefault(int(fields[1]), []).append(process)
    found: list[int] = []
    todo = [ancestor]
    while todo:
        below = children.pop(todo.pop(), [])
        found += below
        todo += below
    return found


def all_processes() -> list[int]:
    """The processes that can be seen from here."""
    return [int(name) for name in os.listdir("/proc") if name.isdigit()]


def tasks_of(user: int) -> int:
    """How many processes and threads a user has, as the kernel counts them for its limit."""
    return sum(int(status["Threads"][0]) for status in _statuses() if int(status["Uid"][0]) == user)


def users() -> set[int]:
    """The ids of all users who have a process that can be seen from here."""
    return {int(id) for status in _statuses() for id in status["Uid"]}


def _statuses() -> Iterator[dict[str, list[str]]]:
    """What the kernel says of each process, by its name for it."""
    for process in all_processes():
        with suppress(OSError):
            lines = (
                Path(f"/proc/{process}/status")
                .read_text(encoding="utf-8", errors="replace")
                .splitlines()
            )
            status = {name: text.split() for name, _, text in (s.partition(":") for s in lines)}
            if status.keys() >= {"Uid", "Threads"}:
                yield status


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
