"""The warm sandboxes of a Dask worker: one for each submission that it grades at a time."""

from __future__ import annotations

import threading
from contextlib import suppress
from queue import Empty, SimpleQueue

from distributed import Reschedule

from autograder.course import Course
from autograder.grading.cluster_messages import pack_result, unpack_order
from autograder.grading.submission import grade_submission
from autograder.marking.marker import Marker
from autograder.sandbox.launcher import Isolation, Sandbox


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
