"""A limit of processor time for what may never end."""

from __future__ import annotations

import signal
from types import TracebackType

from autograder.mutants.mutant import OutOfTime


class time_limit:  # noqa: N801
    """Raises `OutOfTime` in the main thread after so many seconds of a processor's time."""

    def __init__(self, seconds: float) -> None:
        self._seconds = seconds

    def __enter__(self) -> None:
        signal.signal(signal.SIGPROF, self._stop)
        # Once more every second: the first may come where an exception is passed over.
        signal.setitimer(signal.ITIMER_PROF, self._seconds, 1.0)

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        signal.setitimer(signal.ITIMER_PROF, 0)

    @staticmethod
    def _stop(*_: object) -> None:
        raise OutOfTime
