"""Grading on this machine: a thread and a sandbox for each submission at work."""

from __future__ import annotations

from collections.abc import Collection
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from contextlib import ExitStack
from queue import SimpleQueue

from autograder.grading.graded_submission import Graded
from autograder.grading.spread import Task
from autograder.grading.submission import grade_submission
from autograder.marking.marker import Marker
from autograder.sandbox.launcher import Isolation, Sandbox


class Threads:
    """Up to ``jobs`` sandboxes at once, opened when there is something to run in them.

    Only ``questions`` are marked, if they are given. ``isolation`` is as for `Sandbox`.
    """

    def __init__(
        self,
        marker: Marker,
        jobs: int,
        questions: Collection[str] | None = None,
        isolation: Isolation = "auto",
    ) -> None:
        self._marker, self._questions = marker, questions
        self._pool = ThreadPoolExecutor(jobs)
        self._stack = ExitStack()
        self._slots = _Slots(marker, jobs, isolation, self._stack)
        self._tasks: set[Future[Graded]] = set()
        self._more = 0

    def __enter__(self) -> Threads:
        return self

    def __exit__(self, *exception: object) -> None:
        for task in self._tasks:
            task.cancel()
        # In this order: the sandboxes end first, so that no task goes on waiting for an answer.
        self._stack.close()
        self._pool.shutdown()

    @property
    def under_way(self) -> int:
        return len(self._tasks)

    @property
    def has_room(self) -> bool:
        return len(self._tasks) <= 2 * self._slots.count

    @property
    def isolation(self) -> str:
        return self._slots.isolation

    def begin(self, task: Task, more: int) -> None:
        self._more = more
        if self._slots.count == 0:  # only now is there something to run
            ready = self._pool.submit(self._marker.prepare, self._questions)
            self._slots.add()
            ready.result()
        self._tasks.add(self._pool.submit(self._grade, task))

    def finished(self, wait: bool) -> list[Graded]:
        graded = [task.result() for task in self._take_finished(wait)]
        for entry in graded:
            self._slots.grow(entry.seconds, self._more)
        return graded

    def describe(self) -> str:
        return ""

    def _take_finished(self, wait_for_one: bool) -> set[Future[Graded]]:
        timeout = None if wait_for_one else 0
        done, self._tasks = wait(self._tasks, timeout, FIRST_COMPLETED)
        return done

    def _grade(self, task: Task) -> Graded:
        sandbox = self._slots.idle.get()
        try:
            marker = self._marker.with_set(task.set_number)
            return grade_submission(
                task.submission, task.contents, marker, sandbox, self._questions
            )
        finally:
            self._slots.idle.put(sandbox)


class _Slots:
    """The sandboxes of a run: one at first, and another whenever it saves more than it costs."""

    def __init__(self, marker: Marker, most: int, isolation: Isolation, until: ExitStack) -> None:
        self._marker, self._most, self._isolation, self._until = marker, most, isolation, until
        self._graded, self._seconds = 0, 0.0
        self.idle: SimpleQueue[Sandbox] = SimpleQueue()
        self.count = 0
        self.isolation = ""

    def add(self) -> None:
        """Open one more."""
        sandbox = Sandbox(self._marker.course, self._isolation, self._marker.seed)
        self.idle.put(self._until.enter_context(sandbox))
        self.isolation = sandbox.isolation
        self._start_seconds = sandbox.start_seconds
        self.count += 1

    def grow(self, seconds: float, waiting: int) -> None:
        """Open more if the submissions that wait are, at the pace so far, worth it.

        ``seconds`` is what the last submission took.
        """
        self._graded += 1
        self._seconds += seconds
        each = self._seconds / self._graded
        while self.count < self._most:
            saved = waiting * each / (self.count * (self.count + 1))
            if saved < self._start_seconds:
                return
            self.add()
