"""What runs in a Dask worker: it proves that it may grade, and then grades what it is sent.

The coordinator has each worker `prepare`, also those that join late and those that a nanny starts
again. Only a worker that has proven itself offers the resource that each task asks for, so no other
worker is ever given one.
"""

from __future__ import annotations

import asyncio
import signal
import socket
from typing import Any

from distributed import Status, Worker, WorkerPlugin, get_worker

from autograder.course import load_course
from autograder.errors import AutograderError
from autograder.grading.cluster_messages import Broken, pack_result
from autograder.grading.dask_memory import forget_keys
from autograder.grading.dask_requirements import Refused, Wanted, compare, find_root
from autograder.grading.dask_sandboxes import Slots
from autograder.sandbox.launcher import isolation_parts, isolation_text


class GradingPlugin(WorkerPlugin):
    """Proves a worker when it is set up, and then keeps the sandboxes of its slots."""

    def __init__(self, wanted: Wanted) -> None:
        self.wanted = wanted
        self.name = wanted.name
        self.state = "preparing"  # then "ready" or "refused"
        self.reason = ""
        self.isolation = ""

    async def setup(self, worker: Worker) -> None:
        try:
            self._slots = await asyncio.to_thread(self._prepare)
        except AutograderError as error:
            self._refuse(str(error))
        except Exception as error:  # an older autograder, a course of another shape
            self._refuse(f"it could not prepare itself ({type(error).__name__}: {error})")
        else:
            self.state = "ready"
            await worker.set_resources(**{self.name: worker.state.nthreads})
            # Only a worker that becomes free makes the scheduler look at tasks that wait for one.
            if worker.status == Status.running:
                worker.status = Status.paused
                worker.status = Status.running

    async def teardown(self, worker: Worker) -> None:
        if self.state == "ready":
            await asyncio.to_thread(self._slots.close)

    def proof(self) -> dict[str, object]:
        """What the coordinator is told of this worker, as plain data."""
        return {"state": self.state, "reason": self.reason, "isolation": self.isolation}

    def grade(self, data: bytes) -> bytes:
        """Grade one order; an error of this machine's own is the answer, not an exception."""
        forget_keys()
        try:
            result = self._slots.grade(data)
        except AutograderError as error:
            result = pack_result(Broken(str(error)))
            self._withdraw(str(error))
        return result

    def rest(self) -> None:
        """Close the sandboxes that nobody uses now; the next order opens them again."""
        if self.state == "ready":
            self._slots.close_idle()

    def _prepare(self) -> Slots:
        course = load_course(find_root(self.wanted.root))
        compare(self.wanted, course)
        self.isolation = isolation_text(course, self.wanted.isolation)
        missing = set(self.wanted.parts) - set(isolation_parts(course, self.wanted.isolation))
        if missing:
            raise Refused(
                f"its isolation is weaker than the one asked for: it lacks "
                f"{' and '.join(sorted(missing))}; install what `autograder doctor` names there"
            )
        return Slots(course, self.wanted.isolation)

    def _refuse(self, reason: str) -> None:
        self.state, self.reason = "refused", reason

    def _withdraw(self, reason: str) -> None:
        """Take no more work: this machine fails, and another may not."""
        self._refuse(reason)
        worker = get_worker()
        # The scheduler alone is told: what waits here already would never come back otherwise.
        resources = {**worker.state.total_resources, self.name: 0}
        worker.loop.add_callback(
            worker.scheduler.set_resources, resources=resources, worker=worker.contact_address
        )


def dask_setup(worker: Worker) -> None:
    """What a worker of ``--cluster local:N`` does first: leave Ctrl-C to the coordinator."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def grade_here(data: bytes, plugin: str) -> bytes:
    """The task itself: what `Graded` becomes as bytes, from an order as bytes."""
    result: bytes = get_worker().plugins[plugin].grade(data)
    return result


def prepare(wanted: Wanted, dask_worker: Any = None) -> None:
    """Have this worker begin to prove itself, unless that was done before; runs on the worker.

    Nothing is left at the scheduler: there it would be set up on everybody's later workers too, and
    keep those from starting that have no autograder.
    """
    if wanted.name not in dask_worker.plugins:
        plugin = GradingPlugin(wanted)
        dask_worker.loop.add_callback(dask_worker.plugin_add, plugin=plugin, name=wanted.name)


def proof(plugin: str, dask_worker: Any = None) -> dict[str, object]:
    """Who this worker is and whether it has proven itself; runs on the worker."""
    held = dask_worker.plugins.get(plugin)
    said = {"state": "preparing", "reason": "", "isolation": ""} if held is None else held.proof()
    return {**said, "host": socket.gethostname(), "slots": dask_worker.state.nthreads}


def rest(plugin: str, dask_worker: Any = None) -> None:
    """Close what is idle; runs on the worker."""
    held = dask_worker.plugins.get(plugin)
    if held is not None:
        held.rest()
