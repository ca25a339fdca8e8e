"""How long a cell may take: it is interrupted where it runs, by its own process."""

from __future__ import annotations

import math
import signal
import time
from pathlib import Path

_CAN_INTERRUPT = hasattr(signal, "setitimer")


class CellTimeout(KeyboardInterrupt):
    """A cell took longer than it may; like Ctrl-C, `except Exception` does not stop it."""


class Interrupted:
    """Raises `CellTimeout` in the code inside after some seconds, unless that code prevents it.

    They are seconds of a processor; on the clock it may be ``patience`` times as many.
    """

    def __init__(self, seconds: float, patience: float = 1.0) -> None:
        self._seconds, self._patience = seconds, patience
        self._inside = False
        self.fired = False

    def __enter__(self) -> None:
        if _CAN_INTERRUPT and self._seconds < math.inf:
            self._inside = True
            seconds = max(self._seconds, 0.001)
            signal.signal(signal.SIGPROF, self._interrupt)
            signal.signal(signal.SIGALRM, self._interrupt)
            signal.setitimer(signal.ITIMER_PROF, seconds)
            signal.setitimer(signal.ITIMER_REAL, seconds * self._patience)

    def __exit__(self, *exception: object) -> None:
        if self._inside:
            self._inside = False
            signal.setitimer(signal.ITIMER_PROF, 0)
            signal.setitimer(signal.ITIMER_REAL, 0)

    def _interrupt(self, number: int, frame: object) -> None:
        if not self._inside:  # one that was on its way as the code ended
            return
        self.fired = True
        raise CellTimeout


def own_clock() -> float:
    """A clock that stands still while this thread waits for a processor, where Linux tells."""
    try:
        waited = int(Path("/proc/thread-self/schedstat").read_text(encoding="utf-8").split()[1])
    except (OSError, IndexError, ValueError):
        waited = 0
    return time.monotonic() - waited / 1e9
