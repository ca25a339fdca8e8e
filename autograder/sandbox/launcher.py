"""Where student code runs: the best isolation that works here, found by trying.

`Sandbox` and `Session` are all that the rest of the autograder knows of isolation. Student code
never runs in this process, and only plain data comes back.
"""

from __future__ import annotations

import math
import sys
import threading
from typing import TYPE_CHECKING, Literal, cast

from autograder.course import Course
from autograder.sandbox.machine_to_blame import Doubt
from autograder.sandbox.no_isolation_works import SandboxError
from autograder.sandbox.stop_errors import Stopped

if TYPE_CHECKING:
    from autograder.sandbox.host import Host
    from autograder.sandbox.no_isolation import PlainSession
    from autograder.sandbox.tiers import Tier

__all__ = [
    "Isolation",
    "Sandbox",
    "SandboxError",
    "Session",
    "Stopped",
    "isolation_parts",
    "isolation_text",
]

Isolation = Literal["auto", "bubblewrap", "reduced", "none"]
NO_SANDBOX = "none: a separate process with the instructor's rights (--no-sandbox)"

if sys.platform == "linux":
    from autograder.sandbox.session import Session
else:
    from autograder.sandbox.no_isolation import PlainSession as Session


class Sandbox:
    """One worker slot; use its sessions from one thread at a time.

    ``isolation`` names what keeps student code in, for reports. It may be chosen: ``auto`` takes
    the best of ``bubblewrap`` and ``reduced`` that works here, ``none`` is nothing but a process
    of its own. The same ``seed`` makes code that uses chance repeat itself. ``doubt`` is what its
    sessions since it was set leave in doubt.

    Raises:
        SandboxError: on entering, if no isolation works here.
    """

    isolation: str = NO_SANDBOX
    start_seconds = 0.0  # how long starting one takes on this machine

    def __init__(self, course: Course, isolation: Isolation = "auto", seed: int = 0) -> None:
        self._course = course
        self._seed = seed
        self._wanted = isolation
        self._plain = isolation == "none"
        self._host: Host | None = None
        self._sessions: list[Session] = []
        self._stopped = threading.Event()
        self.isolation = NO_SANDBOX
        self.doubt = Doubt()

    def __enter__(self) -> Sandbox:
        if not self._plain:
            self._tier = _tier(self._course, self._wanted)
            self.isolation = self._tier.text
            self.start_seconds = self._tier.seconds
            self._host = self._tier.take_started() or self._tier.start()
        return self

    def __exit__(self, *exception: object) -> None:
        self.stop()

    def session(self, deadline: float = math.inf) -> Session:
        """A fresh process for one notebook of one submission; use it as a context manager.

        After ``deadline``, on the monotonic clock, it begins nothing any more.
        """
        if self._plain:
            from autograder.sandbox.no_isolation import PlainSession

            session = cast("Session", PlainSession(self._course, deadline))
        else:
            settings = self._course.settings
            session = Session(self._take_host, settings, self._seed, deadline, self.doubt)
        self._sessions = [session]
        return session

    def stop(self) -> None:
        """End everything at once; whoever waits for an answer gets `Stopped`."""
        self._stopped.set()
        if self._host is not None:
            self._host.stop()
        for session in self._sessions:
            if self._plain:
                cast("PlainSession", session).stop()

    def _take_host(self) -> Host:
        """The host of this slot; a new one if the last had to be stopped."""
        if self._stopped.is_set():
            raise Stopped("killed", "grading was stopped")
        assert self._host is not None
        if self._host.is_stopped:
            self._host = self._tier.start()
        return self._host


def isolation_text(course: Course, isolation: Isolation = "auto") -> str:
    """What will keep student code in, for reports.

    Raises:
        SandboxError: if no isolation works here.
    """
    return NO_SANDBOX if isolation == "none" else str(_tier(course, isolation).text)


def isolation_parts(course: Course, isolation: Isolation = "auto") -> tuple[str, ...]:
    """The parts of it; an isolation that lacks one is weaker.

    Raises:
        SandboxError: if no isolation works here.
    """
    if isolation == "none":
        return ()
    from autograder.sandbox.tiers import parts

    return parts(_tier(course, isolation).with_namespaces)


def _tier(course: Course, isolation: Isolation) -> Tier:
    if sys.platform != "linux":
        raise SandboxError(
            "Submissions can be isolated only on Linux (on Windows use WSL, on a Mac a Linux "
            "container); --no-sandbox grades them with your own rights."
        )
    from autograder.sandbox.tiers import best_tier

    return best_tier(course, isolation)
