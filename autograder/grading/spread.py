"""Where submissions are graded: the one interface to threads here and to machines elsewhere."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from autograder.grading.graded_submission import Graded
from autograder.intake.submissions import Contents, Submission


@dataclass(frozen=True)
class Task:
    """One submission that was read and is to be graded with a set of hidden inputs."""

    submission: Submission
    contents: Contents
    set_number: int = 0


class Spread(Protocol):
    """Takes tasks and gives back what was graded, in any order; use it from one thread.

    Leaving it as a context manager abandons what is still under way.
    """

    def __enter__(self) -> Spread: ...

    def __exit__(self, *exception: object) -> None: ...

    @property
    def under_way(self) -> int:
        """How many tasks were begun and not given back."""

    @property
    def has_room(self) -> bool:
        """Whether another task is welcome; more than that would only take memory."""

    @property
    def isolation(self) -> str:
        """What keeps student code in there, for reports; empty until something was begun."""

    def begin(self, task: Task, more: int) -> None:
        """Have a task graded; ``more`` are likely to follow.

        Raises:
            SandboxError: if student code cannot be isolated there.
        """

    def finished(self, wait: bool) -> list[Graded]:
        """What has been graded since the last call; if ``wait``, at least one if any is under way.

        Raises:
            AutograderError: if the course or a machine is broken, not a submission.
        """

    def describe(self) -> str:
        """A few words on who is at work, for the progress bar."""
