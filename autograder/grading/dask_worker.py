"""What a Dask worker holds: the proof that it may grade, and a warm sandbox for each of its slots.

The coordinator has each worker `prepare`, also those that join late and those that a nanny starts
again. Only a worker that has proven itself offers the resource that each task asks for, so no other
worker is ever given one.
"""

from __future__ import annotations

import asyncio
import os
import platform
import signal
import socket
import threading
from contextlib import suppress
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path
from queue import Empty, SimpleQueue
from typing import Any

from distributed import Reschedule, Status, Worker, WorkerPlugin, get_worker

from autograder.course import Course, load_course
from autograder.course.read_course import find_course_root
from autograder.errors import AutograderError
from autograder.grading.cluster_messages import Broken, pack_result, unpack_order
from autograder.grading.dask_memory import forget_keys
from autograder.grading.submission import grade_submission
from autograder.marking.marker import Marker
from autograder.sandbox.launcher import Isolation, Sandbox, isolation_parts, isolation_text

# What draws the hidden inputs and computes the expected results.
_LIBRARIES = ("numpy", "sympy", "opencv-python-headless")


@dataclass(frozen=True)
class Wanted:
    """What a worker must be like; ``parts`` are those of the isolation that was asked for."""

    root: str
    version: str
    software: dict[str, str]
    isolation: Isolation
    parts: tuple[str, ...]

    @property
    def name(self) -> str:
        """The same for the same wish: the name of the plugin and of the resource."""
        return f"autograder-{self.version}-{'+'.join(self.parts) or self.isolation}"


class Refused(AutograderError):
    """A worker is not what is wanted; the sentence says why."""


def software() -> dict[str, str]:
    """The versions of what a mark depends on besides the course and the autograder."""
    found = {"Python": ".".join(platform.python_version_tuple()[:2])}
    for name in _LIBRARIES:
        with suppress(PackageNotFoundError):
            found[name] = version(name)
    return found


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
        course = load_course(_find_root(self.wanted.root))
        _compare(self.wanted, course)
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


class Slots:
    """Sandboxes that stay warm from one submission to the next, one for each that is at work."""

    def __init__(self, course: Course, isolation: Isolation) -> None:
        self._course, self._isolation = course, isolation
        self._lock = threading.Lock()
        self._markers: dict[int, Marker] = {}
        self._idle: SimpleQueue[tuple[Sandbox, int]] = SimpleQueue()
        self._open: set[Sandbox] = set()
        self._closed = False

    def grade(self, data: bytes) -> bytes:
        """Grade one order.

        Raises:
            AutograderError: if the course or this machine is broken.
            Reschedule: if the sandboxes were ended meanwhile: what came out says nothing.
        """
        order = unpack_order(data)
        marker = self._marker(order.seed).with_set(order.set_number)
        sandbox = self._take(order.seed)
        try:
            graded = grade_submission(
                order.submission(), order.contents, marker, sandbox, order.questions
            )
        finally:
            self._idle.put((sandbox, order.seed))
            if self._closed:
                raise Reschedule
        return pack_result(graded)

    def close_idle(self) -> None:
        """End the sandboxes that no submission is in."""
        with suppress(Empty):
            while True:
                self._end(self._idle.get_nowait()[0])

    def close(self) -> None:
        """End every sandbox, also those at work."""
        self._closed = True
        for sandbox in list(self._open):
            self._end(sandbox)

    def _marker(self, seed: int) -> Marker:
        with self._lock:  # probes are drawn once, before several threads ask for them
            if seed not in self._markers:
                marker = Marker(self._course, seed, tells=False)
                marker.prepare()
                self._markers = {seed: marker}  # a term's regrading has many seeds
            return self._markers[seed]

    def _take(self, seed: int) -> Sandbox:
        with suppress(Empty):
            while True:
                sandbox, of_seed = self._idle.get_nowait()
                if of_seed == seed:
                    return sandbox
                self._end(sandbox)
        sandbox = Sandbox(self._course, self._isolation, seed).__enter__()
        self._open.add(sandbox)
        return sandbox

    def _end(self, sandbox: Sandbox) -> None:
        sandbox.stop()
        self._open.discard(sandbox)


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


def _find_root(root: str) -> Path:
    """This worker's course: the one that it was started for, or the same place as elsewhere."""
    if "AUTOGRADER_COURSE" not in os.environ and Path(root).is_dir():
        return Path(root)
    return find_course_root()


_loaded: dict[Path, str] = {}


def _compare(wanted: Wanted, course: Course) -> None:
    if _loaded.setdefault(course.root, course.version) != course.version:
        # What was imported before stays in memory, whatever the files say now.
        raise Refused("it still holds an earlier version of the course; restart it")
    if course.version != wanted.version:
        raise Refused(
            f"its course in {course.root} or its autograder is another version "
            f"({course.version}, not {wanted.version}); bring both up to date there"
        )
    for name in course.settings.packages:
        if not find_spec(name.partition(".")[0]):
            raise Refused(f"it lacks the package {name} that the course allows; install it there")
    here = software()
    for name, expected in wanted.software.items():
        if here.get(name) != expected:
            raise Refused(
                f"it has {name} {here.get(name, 'missing')}, not {expected}, so marks could "
                "differ; install the same version there"
            )
