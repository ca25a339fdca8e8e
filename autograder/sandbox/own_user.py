"""A user id that only one sandbox has, so that what it ends or counts is its own."""

from __future__ import annotations

import os
import socket

from autograder.sandbox.processes import users

_IDENTITIES = range(61200, 65200)  # user ids that Linux distributions leave alone


class OwnIdentity:
    """A user id without a name or a process; `release` it when its last process has ended.

    ``number`` is 0 for an ordinary user, who can take no other id.

    Raises:
        OSError: if every id is taken.
    """

    def __init__(self) -> None:
        self.number = 0
        self._lock: socket.socket | None = None
        if os.geteuid() == 0:
            self.number, self._lock = _take()

    def release(self) -> None:
        """Let others have the id."""
        if self._lock is not None:
            self._lock.close()


def _take() -> tuple[int, socket.socket]:
    taken = users()  # also those whom a killed run left behind
    for number in _IDENTITIES:
        if number in taken:
            continue
        # A name without a file: one process at a time has it, and it goes when that process ends.
        lock = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        try:
            lock.bind(f"\0autograder-identity-{number}")
        except OSError:
            lock.close()
        else:
            return number, lock
    raise OSError("every user id for sandboxes is taken: end other runs of the autograder")
