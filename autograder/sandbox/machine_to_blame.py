"""Whether what stopped a submission may have been this machine's doing, not the student's."""

from __future__ import annotations

from dataclasses import dataclass

_FAR_BELOW = 0.5  # of a limit: what was used of a student's own time where the machine was slow


@dataclass
class Doubt:
    """What the sessions of one submission leave in doubt.

    Student code can raise a doubt too, by ending itself as the system would: it is then run once
    more, and what comes out counts.
    """

    is_unexplained: bool = False  # ended by nobody's limit
    ran_out: bool = False  # of the time that the submission as a whole may take
    open_seconds: float = 0.0  # how long its processes were there
    own_seconds: float = 0.0  # how much of it was their own time

    def look(self, had: float | None, limit: float) -> None:
        """Compare the time that was had with the limit at which the student was stopped."""
        if had is not None and had < _FAR_BELOW * limit:
            self.is_unexplained = True

    @property
    def is_doubtful(self) -> bool:
        """Whether the submission should be tried once more, alone."""
        slow = self.own_seconds < _FAR_BELOW * self.open_seconds
        return self.is_unexplained or (self.ran_out and slow)
