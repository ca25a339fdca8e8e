"""The processes that student code leaves behind: found, counted and ended."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path

_SWEEP_SECONDS = 5.0
_EXIT_SECONDS = 1.0  # for a process that has no more to do than to give its memory back


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
