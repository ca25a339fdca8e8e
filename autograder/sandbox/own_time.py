"""How long the processes of one notebook have had, whatever else the machine had to do meanwhile.

What others do is no student's fault: while a process could run and is not given a processor, no
time passes for it. While all of them sleep, time passes as on a clock; what several of them use at
once adds up.
"""

from __future__ import annotations

import os
import resource
import time
from bisect import bisect_right
from contextlib import suppress

from autograder.sandbox.processes import stat_fields

_TICKS = os.sysconf("SC_CLK_TCK")
_COULD_RUN = (b"R", b"D")  # running or waiting for a processor, and waiting for a disk


class OwnTime:
    """The time of one notebook's processes, seen from the process that forked them.

    Call `look` often: what happens between two looks is taken for alike.
    """

    def __init__(self) -> None:
        self.begin()

    def begin(self) -> None:
        """Begin anew, with no process yet."""
        self._when = [time.monotonic()]
        self._had = [0.0]
        self._used = _of_ended()

    def look(self, processes: list[int]) -> None:
        """Count what has passed since the last look."""
        used, could_run = _of_ended(), False
        for process in processes:
            with suppress(OSError, ValueError, IndexError):  # it has just ended
                stat = stat_fields(process)
                could_run = could_run or stat[0] in _COULD_RUN
                # Its own, and that of its children that it has waited for.
                used += sum(map(int, stat[11:15])) / _TICKS
        now = time.monotonic()
        # Less than before means that somebody's children went without being waited for.
        worked = max(0.0, used - self._used)
        slept = 0.0 if could_run else now - self._when[-1]
        self._used = used
        self._when.append(now)
        self._had.append(self._had[-1] + max(worked, slept))

    def since(self, moment: float) -> float:
        """The seconds since a moment on the monotonic clock."""
        at = max(0, bisect_right(self._when, moment) - 1)
        return self._had[-1] - self._had[at]


def _of_ended() -> float:
    """The processor time of this process's ended children, in seconds."""
    ended = resource.getrusage(resource.RUSAGE_CHILDREN)
    return ended.ru_utime + ended.ru_stime
