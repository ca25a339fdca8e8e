"""What Dask remembers of each task and does beside the work, cut short.

A run of any size is to need the same memory. Each of these would grow by some hundred bytes a task
or, where it holds the work of students, by as much as they handed in. Nothing of it is needed to
grade.
"""

from __future__ import annotations

from typing import Any

from dask.typing import Key
from dask.utils import key_split
from distributed.spans import SpansSchedulerExtension

_MOST_KEYS = 200

# Settings of Dask's, here and on the workers that are started here.
BRIEF = {
    # Of messages, which hold the work of students.
    "distributed.admin.low-level-log-length": 20,
    "distributed.diagnostics.computations.max-history": 10,
    "distributed.admin.system-monitor.log-length": 60,
    # What else each process does while it waits: together 6 % of a core for two workers.
    "distributed.admin.system-monitor.interval": "2s",
    "distributed.admin.system-monitor.disk": False,
    "distributed.admin.system-monitor.gil.enabled": False,
    "distributed.admin.tick.interval": "1s",
    # As soon as somebody looks at that page of the dashboard.
    "distributed.scheduler.dashboard.tasks.task-stream-length": 1000,
}


class NoSpans(SpansSchedulerExtension):
    """The scheduler's extension that keeps an entry for each task, without them."""

    def observe_tasks(self, *tasks: object, **more: object) -> dict[Key, dict[Any, Any]]:
        """Remember nothing of new tasks."""
        return {}

    def heartbeat(self, *measured: object) -> None:
        """Remember nothing of what a worker measured."""


def forget_keys() -> None:
    """Empty the table in which Dask looks up the group of a key; it would hold 100,000 of them."""
    if key_split.cache_info().currsize > _MOST_KEYS:
        key_split.cache_clear()
