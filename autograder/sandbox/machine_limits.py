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

OPEN_FILES = 256  # for a notebook; the grader itself needs about twenty for each job
_WARM_MB = 1536  # of addresses, for Python and its libraries
_BESIDE = 8  # processes: bubblewrap, the zygote, and what is just ending
_CGROUPS = Path("/sys/fs/cgroup")


def require_room(settings: Settings) -> None:
    """Take what this process may have, and refuse to grade where that is not enough.

    Raises:
        MachineError: naming the limit, what it is and what it must be.
    """
    for kind, letter, needed, words in (
        (resource.RLIMIT_NOFILE, "n", OPEN_FILES, "open files"),
        (resource.RLIMIT_NPROC, "u", settings.processes + _BESIDE, "processes"),
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
    if left is not None and left < settings.processes + _BESIDE:
        raise MachineError(
            f"This container allows {left} more processes (pids.max), and a notebook may use "
            f"{settings.processes + _BESIDE}: student work would fail for it. Allow more (docker "
            "run --pids-limit), or change processes in [tool.autograder]; then grade again."
        )


def _processes_left() -> Iterator[int]:
    """How many processes each control group that this one is in has left."""
    groups: list[Path] = []
    with suppress(OSError):
        for line in Path("/proc/self/cgroup").read_text(encoding="utf-8").splitlines():
            _, controllers, path = line.split(":", 2)
            if controllers in ("", "pids"):
                for top in (_CGROUPS, _CGROUPS / "unified", _CGROUPS / "pids"):
                    group = top / path.strip("/")
                    groups += [g for g in (group, *group.parents) if g.is_relative_to(top)]
    for group in dict.fromkeys(groups):
        with suppress(OSError, ValueError):
            yield int((group / "pids.max").read_text()) - int((group / "pids.current").read_text())
