"""Jobs shared out to processes, one for each processor, that can be ended: a mutant may hang."""

from __future__ import annotations

import multiprocessing
import os
import time
from collections.abc import Iterator, Sequence
from multiprocessing.connection import wait
from pathlib import Path
from typing import Any

from autograder.authoring.proof_job import Job, serve

_PATIENCE = 120.0  # seconds of its own without an answer after which a process is ended


def share_out(root: Path, jobs: Sequence[Job]) -> Iterator[tuple[Job, Any]]:
    """Each job with its result, None for one that had to be ended.

    A process stays with a question as long as there are jobs of it: to make a question's cases
    ready takes longer than many a job.
    """
    left: dict[str, list[Job]] = {}
    for job in jobs:
        left.setdefault(job.question, []).append(job)
    processes: list[_Process] = []
    try:
        for _ in range(min(len(jobs), _processors())):
            processes.append(_Process(root))
            processes[-1].give(_next(left, processes, ""))
        while processes:
            ready = wait([process.pipe for process in processes], timeout=5.0)
            for process in list(processes):
                try:
                    if process.pipe in ready:
                        result = process.pipe.recv()
                    elif process.had() > _PATIENCE:
                        raise EOFError
                    else:
                        continue
                except (EOFError, OSError):
                    result = None
                    process.end()
                    processes[processes.index(process)] = new = _Process(root)
                    new.job, process = process.job, new
                yield process.job, result
                if left:
                    process.give(_next(left, processes, process.job.question))
                else:
                    processes.remove(process)
                    process.end()
    finally:
        for process in processes:
            process.end()


def _next(left: dict[str, list[Job]], processes: Sequence[_Process], last: str) -> Job:
    """The next job: of the same question, of one that nobody works at, of the one with most."""
    taken = {process.job.question for process in processes if process.job}
    free = [id for id in left if id not in taken]
    id = last if last in left else free[0] if free else max(left, key=lambda id: len(left[id]))
    job = left[id].pop(0)
    if not left[id]:
        del left[id]
    return job


def _processors() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else 2


class _Process:
    job: Any = None
    _when: float  # of the last look
    _used: float  # seconds of a processor, by then

    def __init__(self, root: Path) -> None:
        context = multiprocessing.get_context("spawn")
        self.pipe, theirs = context.Pipe()
        self._process = context.Process(target=serve, args=(root, theirs), daemon=True)
        self._process.start()
        theirs.close()
        self._begin()

    def give(self, job: Job) -> None:
        self.job = job
        self._begin()
        self.pipe.send(job)

    def had(self) -> float:
        """The seconds for its job so far; none pass while it waits for a processor."""
        now, (used, could_run) = time.monotonic(), _looked_at(self._process.pid)
        slept = 0.0 if could_run else now - self._when
        self._had += max(used - self._used, slept)
        self._when, self._used = now, used
        return self._had

    def _begin(self) -> None:
        self._had, self._when = 0.0, time.monotonic()
        self._used, _ = _looked_at(self._process.pid)

    def end(self) -> None:
        self.pipe.close()
        self._process.kill()
        self._process.join()


def _looked_at(process: int | None) -> tuple[float, bool]:
    """A process's seconds of a processor, and whether it could run; where nothing tells, no."""
    try:
        state = Path(f"/proc/{process}/stat").read_bytes().rpartition(b")")[2].split()
        ticks = int(state[11]) + int(state[12])
        return ticks / os.sysconf("SC_CLK_TCK"), state[0] in (b"R", b"D")
    except (OSError, AttributeError, ValueError, IndexError):
        return 0.0, False
