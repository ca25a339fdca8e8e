"""Whether this machine allows what a notebook may use, looked at before anything runs.

A limit of a shell or a container that is lower than the course's would become a student's mark.
"""

from __future__ import annotations

import resource
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from autograder.course import Settings
from autograder.errors import MachineError
from autograder.sandbox.control_group import BESIDE, own_groups

OPEN_FILES = 256  # for a notebook; the grader itself needs about twenty for each job
_WARM_MB = 1536  # of addresses, for Python and its libraries
_CGROUPS = Path("/sys/fs/cgroup")


def require_room(settings: Settings) -> None:
    """Take what this process may have, and refuse to grade where that is not enough.

    Raises:
        MachineError: naming the limit, what it is and what it must be.
    """
    for kind, letter, needed, words in (
        (resource.RLIMIT_NOFILE, "n", OPEN_FILES, "open files"),
        (resource.RLIMIT_NPROC, "u", settings.processes + BESIDE, "processes"),
        (resource.RLIMIT_FSIZE, "f", settings.files_mb * 2**20, "bytes in a file"),
        (resource.RLIMIT_CPU, "t", settings.cpu_seconds + 1, "seconds of a processor"),
        (
            resource.RLIMIT_AS,
            "v",
            (settings.memory_mb + _WARM_MB) * 2**20,
            "bytes of memory",
        ),
    ):
        soft, hard = resource.getrlimit(kind)
        if hard != resource.RLIM_INFINITY and hard < needed:
            raise MachineError(
                f"This shell allows {hard} {words} (ulimit -{letter}), and a notebook may use "
                f"{needed}: student work would fail for it. Allow more, or change the course's "
                "limits in [tool.autograder]; then grade again."
            )
        if soft != resource.RLIM_INFINITY and (soft < needed or kind == resource.RLIMIT_NOFILE):
            most = 65536 if kind == resource.RLIMIT_NOFILE else hard
            wanted = most if hard == resource.RLIM_INFINITY else min(hard, most)
            with suppress(OSError, ValueError):
                resource.setrlimit(kind, (max(soft, wanted), hard))
    left = min(_processes_left(), default=None)
    if left is not None and left < settings.processes + BESIDE:
        raise MachineError(
            f"This container allows {left} more processes (pids.max), and a notebook may use "
            f"{settings.processes + BESIDE}: student work would fail for it. Allow more (docker "
            "run --pids-limit), or change processes in [tool.autograder]; then grade again."
        )


def _processes_left() -> Iterator[int]:
    """How many processes each control group that this one is in has left."""
    tops = (_CGROUPS, _CGROUPS / "unified", _CGROUPS / "pids")
    groups = [group for top in tops for group in own_groups(top, ("", "pids"))]
    for group in dict.fromkeys(groups):
        with suppress(OSError, ValueError):
            yield int((group / "pids.max").read_text()) - int((group / "pids.current").read_text())
