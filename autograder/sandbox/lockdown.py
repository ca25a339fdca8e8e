"""What a process does to itself before it runs student code, and can never undo."""

from __future__ import annotations

import ctypes
import errno
import os
import resource
import signal
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path

from autograder.sandbox import seccomp
from autograder.sandbox.landlock import Ruleset

_SET_PARENT_DEATH_SIGNAL, _SET_DUMPABLE, _DROP_BOUNDING_CAPABILITY = 1, 4, 24
_SET_NO_NEW_PRIVILEGES, _SET_CHILD_SUBREAPER = 38, 36
_KEEP_CAPABILITIES = 8
_CAPABILITY_VERSION = 0x20080522
_READ_EVERYWHERE = 1 << 2  # CAP_DAC_READ_SEARCH


@dataclass(frozen=True)
class Limits:
    """What one process of student code may use; ``processes`` holds for all of them together.

    The kernel counts all that a user runs. Where that is more than student code, `beside` adds what
    runs already and ``spare``, for what the user starts meanwhile.
    """

    memory_mb: int
    cpu_seconds: int
    processes: int
    spare: int
    file_mb: int

    def beside(self, tasks: int) -> Limits:
        """The limits for a user who runs some tasks already; what is spare may be less."""
        needed, allowed = self.processes + tasks, resource.getrlimit(resource.RLIMIT_NPROC)[1]
        if allowed == resource.RLIM_INFINITY:
            allowed = needed + self.spare
        return replace(self, processes=max(needed, min(needed + self.spare, allowed)))


def limit_resources(limits: Limits) -> None:
    """Set the kernel's limits; memory counts from what the process has already.

    Raises:
        OSError: if this machine allows less than a notebook may use; the error names which limit.
    """
    pages = int(Path("/proc/self/statm").read_text(encoding="utf-8").split()[0])
    memory = pages * resource.getpagesize() + limits.memory_mb * 2**20
    for kind, value in (
        (resource.RLIMIT_AS, memory),
        (resource.RLIMIT_NPROC, limits.processes),
        (resource.RLIMIT_FSIZE, limits.file_mb * 2**20),
        (resource.RLIMIT_NOFILE, 256),
        (resource.RLIMIT_CORE, 0),
        (resource.RLIMIT_MEMLOCK, 0),
        (resource.RLIMIT_MSGQUEUE, 0),
    ):
        _limit(kind, value, value)
    # Were both alike, the kernel would kill without the signal that says why.
    _limit(resource.RLIMIT_CPU, limits.cpu_seconds, limits.cpu_seconds + 1)
    # A file over the limit is an error in the code that writes it, not the end of the process.
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)


def _limit(kind: int, soft: int, hard: int) -> None:
    allowed = resource.getrlimit(kind)[1]
    if allowed != resource.RLIM_INFINITY and allowed < hard:
        # The course says what a student may use: less would become a mark.
        number = {resource.RLIMIT_AS: errno.ENOMEM, resource.RLIMIT_NOFILE: errno.EMFILE}
        raise OSError(number.get(kind, errno.EAGAIN), "a limit is too low")
    resource.setrlimit(kind, (soft, hard))


def drop_rights(identity: int, keep_reading: bool) -> None:
    """Give up every capability for good and, as root, become a user without a name or files.

    ``keep_reading`` keeps the one right to read what the file modes close to others; use it only
    together with Landlock.
    """
    for capability in range(64):
        if _prctl(_DROP_BOUNDING_CAPABILITY, capability, check=False) != 0:
            break
    if identity:
        _prctl(_KEEP_CAPABILITIES, int(keep_reading))
        os.setgroups([])
        os.setresgid(identity, identity, identity)
        os.setresuid(identity, identity, identity)

    class Header(ctypes.Structure):
        _fields_ = [("version", ctypes.c_uint32), ("pid", ctypes.c_int)]

    kept = _READ_EVERYWHERE if identity and keep_reading else 0
    sets = (ctypes.c_uint32 * 6)(kept, kept, 0, 0, 0, 0)  # effective, permitted, inheritable
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.capset(ctypes.byref(Header(_CAPABILITY_VERSION, 0)), sets) != 0:
        raise OSError(ctypes.get_errno(), "capset")


def hide_memory() -> None:
    """No other process may read this one's memory or environment."""
    _prctl(_SET_DUMPABLE, 0)


def show_memory() -> None:
    """Let the zygote see how much memory this process uses."""
    _prctl(_SET_DUMPABLE, 1)


def die_with_parent() -> None:
    """End when the parent ends."""
    _prctl(_SET_PARENT_DEATH_SIGNAL, signal.SIGKILL)


def adopt_orphans() -> None:
    """Become the parent of every descendant whose own parent ended."""
    _prctl(_SET_CHILD_SUBREAPER, 1)


def give_way(process: int) -> None:
    """Let a process, and all it starts from now on, run only when nobody else wants the processor.

    Being confined, it cannot take that back.
    """
    with suppress(OSError):
        os.sched_setscheduler(process, os.SCHED_IDLE, os.sched_param(0))


def close_other_descriptors(*keep: int) -> None:
    """Close everything but the given descriptors."""
    low = 0
    for descriptor in sorted(keep):
        if low < descriptor:  # closerange(0, 0) closes everything in some versions of Python
            os.closerange(low, descriptor)
        low = descriptor + 1
    os.closerange(low, 1024)


def confine(ruleset: Ruleset | None, program: bytes | None) -> None:
    """Put this process under Landlock and seccomp, as far as they are given."""
    _prctl(_SET_NO_NEW_PRIVILEGES, 1)
    if ruleset is not None:
        ruleset.apply()
    if program is not None:
        seccomp.install(program)


def _prctl(option: int, value: int, check: bool = True) -> int:
    libc = ctypes.CDLL(None, use_errno=True)
    arguments = [ctypes.c_ulong(value), *[ctypes.c_ulong(0)] * 3]
    result: int = libc.prctl(ctypes.c_int(option), *arguments)
    if check and result != 0:
        raise OSError(ctypes.get_errno(), f"prctl {option}")
    return result
