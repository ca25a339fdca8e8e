"""Grading on a Dask cluster: tasks go to workers that have proven themselves, marks come back.

Scheduling, retries and heartbeats are Dask's. Kept here is what Dask cannot know: no submission may
be blamed for the death of a worker that it shared with others.
"""

from __future__ import annotations

import hashlib
import time
from collections.abc import Callable, Collection
from contextlib import ExitStack
from dataclasses import dataclass, replace

from distributed import Client, Future, KilledWorker, as_completed

from autograder.course import Course
from autograder.grading.cluster_messages import pack_order, unpack_result
from autograder.grading.dask_address import ClusterAddress
from autograder.grading.dask_connection import ClusterError, connect, gone, gone_in_one_sentence
from autograder.grading.dask_crew import Crew
from autograder.grading.dask_memory import forget_keys
from autograder.grading.dask_requirements import Wanted, software
from autograder.grading.dask_worker import grade_here
from autograder.grading.graded_submission import Graded, same_mark_for_all
from autograder.grading.spread import Task
from autograder.marking.marker import Marker
from autograder.sandbox.launcher import NO_SANDBOX, Isolation, SandboxError, isolation_parts

_MOST_UNDER_WAY = 400
_POLL_SECONDS = 0.05  # workers have other work waiting meanwhile
_MOST_BYTES = 256 * 2**20  # of contents under way


@dataclass(frozen=True)
class _Sent:
    """A task that was sent; a later ``attempt`` has another key, so that Dask runs it anew."""

    task: Task
    data: bytes
    attempt: int = 0
    alone: bool = False


class DaskCluster:
    """Spreads tasks over the workers of a Dask scheduler, as `autograder.grading.spread` says.

    Nothing is started or connected to before there is something to grade. ``tell`` is given
    sentences for the person who waits.

    A task whose worker dies is run again by Dask, elsewhere. One that was there at three deaths is
    suspect, and so is all that shared those workers with it; suspects are run one by one when
    nothing else is under way. Whatever kills its workers again then is marked ``killed``.
    """

    def __init__(
        self,
        marker: Marker,
        address: ClusterAddress,
        questions: Collection[str] | None = None,
        isolation: Isolation = "auto",
        tell: Callable[[str], None] = print,
    ) -> None:
        self._marker, self._address, self._questions = marker, address, questions
        self._isolation, self._tell = isolation, tell
        self._wanted = _wanted(marker.course, isolation)
        self._stack = ExitStack()
        self._client: Client | None = None
        self._crew: Crew | None = None
        self._sent: dict[object, tuple[_Sent, Future]] = {}
        self._suspects: list[_Sent] = []
        self._bytes = 0

    def __enter__(self) -> DaskCluster:
        return self

    def __exit__(self, *exception: object) -> None:
        if self._crew is not None:
            if exception[0] is None:
                self._crew.rest()
            self._crew.close()
        self._sent.clear()
        self._stack.close()

    @property
    def under_way(self) -> int:
        return len(self._sent) + len(self._suspects)

    @property
    def has_room(self) -> bool:
        slots = self._crew.slots if self._crew else 1
        return len(self._sent) < min(_MOST_UNDER_WAY, 4 + 3 * slots) and self._bytes < _MOST_BYTES

    @property
    def isolation(self) -> str:
        if self._isolation == "none":
            return NO_SANDBOX
        return self._crew.isolation if self._crew else ""

    def describe(self) -> str:
        return self._crew.describe() if self._crew else "waiting for workers"

    def begin(self, task: Task, more: int) -> None:
        if self._client is None:
            self._start()
        self._send(_Sent(task, pack_order(task, self._marker.seed, self._questions)))

    def finished(self, wait: bool) -> list[Graded]:
        graded: list[Graded] = []
        while True:
            for future, result in self._take_ready():
                graded += self._understand(future, result)
            if graded or not wait or not self.under_way:
                return graded
            if not self._sent:
                self._send(self._suspects.pop())
            assert self._client is not None
            assert self._crew is not None
            if self._client.status != "running":
                raise gone(self._address)
            with gone_in_one_sentence(self._address):
                self._crew.look_after()
            if not self._completed.has_ready():
                # Not on its condition: Ctrl-C while that takes its lock again leaves it without.
                time.sleep(_POLL_SECONDS)

    def _start(self) -> None:
        self._client = self._stack.enter_context(connect(self._address))
        self._completed = as_completed(
            [], loop=self._client.loop, with_results=True, raise_errors=False
        )
        with gone_in_one_sentence(self._address):
            self._crew = Crew(self._client, self._wanted, self._tell)
            self._crew.wait_for_first()

    def _send(self, sent: _Sent) -> None:
        assert self._client is not None
        forget_keys()
        with gone_in_one_sentence(self._address):
            future = self._client.submit(
                grade_here,
                sent.data,
                self._wanted.name,
                key=self._key(sent),
                resources={self._wanted.name: 1},
                pure=False,
            )
        self._sent[future.key] = sent, future
        self._bytes += len(sent.data)
        self._completed.add(future)

    def _key(self, sent: _Sent) -> tuple[str | int, ...]:
        """The address of the work: the same work has the same, so that twice is once.

        The first part is what Dask's dashboard groups by; the second, the student, is for people.
        """
        student = sent.task.submission.student.encode("utf-8", "replace").decode()
        matter = (sent.task.contents.fingerprint, self._wanted.name, self._questions)
        digest = hashlib.sha256(repr(matter).encode("utf-8", "replace")).hexdigest()[:16]
        return ("grade", student, digest, self._marker.seed, sent.attempt)

    def _take_ready(self) -> list[tuple[Future, object]]:
        """What came to an end since the last call: each future once, with what Dask fetched."""
        if not self._sent:
            return []
        came: list[tuple[Future, object]] = self._completed.next_batch(block=False)
        ready = {future.key: (future, result) for future, result in came}
        # What comes to a bad end while its result is fetched is never said to be completed.
        for _, future in self._sent.values():
            if future.status in ("error", "cancelled"):
                ready.setdefault(future.key, (future, None))
        return [ended for key, ended in ready.items() if key in self._sent]

    def _understand(self, future: Future, result: object) -> list[Graded]:
        """What came back for a task; nothing if it is sent once more."""
        sent, _ = self._sent.pop(future.key)
        self._bytes -= len(sent.data)
        error = self._error_of(future)
        future.release()
        # The status does not count here: once a worker has died, Dask calls all its results lost,
        # those that were fetched before too.
        if isinstance(result, bytes):
            came = unpack_result(result, sent.task.submission)
            if isinstance(came, Graded):
                return [came]
            return self._worker_is_broken(sent)
        if error is not None:
            if isinstance(error, KilledWorker):
                return self._worker_died(sent, error)
            raise ClusterError(
                f"A worker failed in a way that says nothing about the submission of "
                f"{sent.task.submission.student} ({type(error).__name__}); look at the "
                "workers' output, then run this command again to go on."
            ) from error
        raise gone(self._address)

    def _error_of(self, future: Future) -> BaseException | None:
        if future.status != "error":
            return None
        with gone_in_one_sentence(self._address):
            error: BaseException = future.exception()
        return error

    def _worker_is_broken(self, sent: _Sent) -> list[Graded]:
        assert self._crew is not None
        self._crew.ask_again()
        self._send(replace(sent, attempt=sent.attempt + 1))
        return []

    def _worker_died(self, sent: _Sent, error: KilledWorker) -> list[Graded]:
        if not sent.alone:
            self._suspects.append(replace(sent, attempt=sent.attempt + 1, alone=True))
            return []
        said = (
            f"Grading this submission ended its worker {error.allowed_failures + 1} times while "
            "nothing else was graded; the points say nothing about the work. Mark it by hand, and "
            "report the failure."
        )
        contents = sent.task.contents
        marks = same_mark_for_all(self._marker.course, "killed", said, self._questions)
        notes = (*contents.notes, said)
        return [Graded(sent.task.submission, "graded", contents.fingerprint, marks, notes)]


def _wanted(course: Course, isolation: Isolation) -> Wanted:
    try:
        parts = isolation_parts(course, isolation)
    except SandboxError:  # this machine cannot, but workers may
        parts = ()
    return Wanted(str(course.root), course.version, software(), isolation, parts)
