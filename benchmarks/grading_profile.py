"""Where the processor time of a graded class goes: grader, zygotes, students' own processes."""

from __future__ import annotations

import os
import resource
import subprocess
import time
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

_ZYGOTE = b"autograder.sandbox.inside.zygote"
_LOOK = 0.02  # seconds between two looks


class Profile(NamedTuple):
    """Seconds of a processor for a class, by whose they are."""

    grader: float  # reading, marking, gradebook, pages
    zygotes: float  # importing the libraries once, clearing up between submissions
    students: float  # cells, and the calls of their functions
    rest: float  # trying the isolation out, bubblewrap


class _Times(NamedTuple):
    """What a process and its ended children had, in seconds."""

    own: float
    children: float


def profile(command: Sequence[str], folder: Path, environment: Mapping[str, str]) -> Profile:
    """Run a grading command, and look at its processes on the way.

    Raises:
        RuntimeError: if it fails.
    """
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    process = subprocess.Popen(command, cwd=folder, env=environment, stdout=subprocess.DEVNULL)
    grader, zygotes = _Times(0, 0), dict[int, _Times]()
    while process.poll() is None:
        grader = _times(process.pid) or grader
        for zygote in _zygotes_below(process.pid):
            zygotes[zygote] = _times(zygote) or zygotes.get(zygote, _Times(0, 0))
        time.sleep(_LOOK)
    if process.returncode != 0:
        raise RuntimeError(f"{command} failed")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    total = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    own = sum(times.own for times in zygotes.values())
    students = sum(times.children for times in zygotes.values())
    return Profile(grader.own, own, students, total - grader.own - own - students)


def profile_table(profiles: Mapping[str, tuple[Profile, int]]) -> list[str]:
    """The lines of a table: a row for each class, which comes with its number of submissions."""
    lines = [
        "| class | students' processes | zygotes | grader | rest | CPU a submission [s] |",
        "|---|---|---|---|---|---|",
    ]
    for name, (found, submissions) in profiles.items():
        shares = " | ".join(
            f"{100 * part / sum(found):.0f} %"
            for part in (found.students, found.zygotes, found.grader, found.rest)
        )
        lines.append(f"| {name} | {shares} | {sum(found) / submissions:.3f} |")
    return lines


def _zygotes_below(ancestor: int) -> list[int]:
    """The zygotes that a process has started, or one that it started."""
    parents, zygotes = dict[int, int](), set[int]()
    for name in filter(str.isdigit, os.listdir("/proc")):
        with suppress(OSError, IndexError):
            parents[int(name)] = int(_stat(int(name))[1])
            program, *arguments = Path(f"/proc/{name}/cmdline").read_bytes().split(b"\0")
            if _ZYGOTE in arguments and not program.endswith(b"bwrap"):
                zygotes.add(int(name))
    # A student's process is a fork of a zygote and has its command line.
    return [
        zygote
        for zygote in zygotes
        if parents[zygote] not in zygotes and _is_below(zygote, ancestor, parents)
    ]


def _is_below(process: int, ancestor: int, parents: Mapping[int, int]) -> bool:
    while process > 1 and process != ancestor:
        process = parents.get(process, 0)
    return process == ancestor


def _times(process: int) -> _Times | None:
    tick = os.sysconf("SC_CLK_TCK")
    with suppress(OSError, IndexError):
        user, system, children_user, children_system = map(int, _stat(process)[11:15])
        return _Times((user + system) / tick, (children_user + children_system) / tick)
    return None


def _stat(process: int) -> list[bytes]:
    """The fields from the state on, behind the process's name."""
    return Path(f"/proc/{process}/stat").read_bytes().rpartition(b")")[2].split()
