"""One notebook of one submission in a sandbox, asked from the trusted side."""

from __future__ import annotations

import math
import re
import secrets
import select
import signal
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field

from autograder.course import Settings
from autograder.exchange import wire
from autograder.exchange.channel import Channel, Late
from autograder.exchange.messages import Evaluation, Message, Report
from autograder.exchange.replies import clean_evaluation, clean_report
from autograder.language import N_
from autograder.sandbox.host import Host, HostError
from autograder.sandbox.machine_to_blame import Doubt
from autograder.sandbox.notebook_limits import limits
from autograder.sandbox.stop_errors import BY_THE_SYSTEM, Stopped, out_of_time, stop_by

GRACE = 1.0  # seconds between the child's own limit and the one kept here
PATIENCE = 20  # times a limit: how long to wait for a child that is given no processor
# What may come from one process without answering anything before its channel counts as broken:
# reading it costs the grader time, which belongs to all submissions.
MAX_STRAY = 16  # messages; a process that a response forked and forgot may well send one
MAX_STRAY_BYTES = 2**20  # notices that a cell begins included
MAX_RESTARTS = 3
_MESSAGE_SECONDS = 20.0  # for the rest of a message of which the beginning has come


class Session:
    """Runs one notebook and evaluates what it left.

    Every answer must carry the nonce of its question and come before a deadline that is kept here.
    When a cell hangs or crashes beyond what the child itself can catch, the notebook is run again
    without that cell; when a response does, the next question still works. After ``deadline``, on
    the monotonic clock, nothing is begun any more.
    """

    def __init__(
        self,
        take_host: Callable[[], Host],
        settings: Settings,
        seed: int,
        deadline: float = math.inf,
        doubt: Doubt | None = None,
    ) -> None:
        self._take_host = take_host
        self._doubt = Doubt() if doubt is None else doubt
        self._deadline = deadline
        self._settings = settings
        self._seed = seed
        self._host: Host | None = None
        self._channel: Channel | None = None
        self._cells: list[str] = []
        self._stopped_cells: dict[int, Stopped] = {}
        self._restarts_left = MAX_RESTARTS
        self._begun_anew = False
        self._in_cell: int | None = None
        self._strays, self._stray_bytes = 0, 0
        self._limits: list[_Limit] = []
        self._was_interrupted = False

    def __enter__(self) -> Session:
        return self

    def __exit__(self, *exception: object) -> None:
        self._close()

    def run(self, cells: list[str], names: list[str]) -> Report:
        """Run the cells; ``names`` are the variables whose understood value is wanted.

        The report has ``errors`` (for each cell the class of its exception, ``timeout``, ``killed``
        or None), ``responses`` (what ``ask(...).respond(...)`` recorded, by question) and
        ``understood`` (a short text for each name).

        Raises:
            Stopped: if no run of the notebook came to its end.
        """
        self._cells, self._stopped_cells, self._begun_anew = cells, {}, False
        self._check_deadline()
        return self._run(names)

    def evaluate(self, name: str, probe: Message) -> Evaluation:
        """Evaluate the response held by ``name``, as `autograder.sandbox.inside.evaluate` says.

        Raises:
            Stopped: if it takes too long, if its process dies, or if the cell that should define it
                was stopped.
        """
        self._check_deadline()
        if self._channel is None:
            self._restart()
            self._run([])
        try:
            reply = self._reply_to(name, probe)
        except Stopped:
            if not self._may_begin_anew(name):
                raise
            # What an interrupted cell left running, such as a fork bomb, may have taken the time or
            # the memory of the cells after it and of the evaluation: begin anew without it, once.
            self._begun_anew = True
            first = min(self._stopped_cells)
            self._stopped_cells = {first: self._stopped_cells[first]}
            self._close()
            self._restart()
            self._run([])
            reply = self._reply_to(name, probe)
        return reply

    def _may_begin_anew(self, name: str) -> bool:
        """Whether another cell than the one that should define ``name`` may be to blame."""
        if self._begun_anew or not self._stopped_cells or self._restarts_left == 0:
            return False
        return not _mentions(self._cells[min(self._stopped_cells)], name)

    def _reply_to(self, name: str, probe: Message) -> Evaluation:
        reply = clean_evaluation(self._ask_to_evaluate(name, probe)["reply"])
        if reply.get("reason") == "missing":
            for index, stop in self._stopped_cells.items():
                if _mentions(self._cells[index], name):
                    raise Stopped(stop.status, stop.why)
        return reply

    def _ask_to_evaluate(self, name: str, probe: dict[str, object]) -> dict[str, object]:
        seconds = min(self._settings.question_seconds, self._deadline - time.monotonic())
        if seconds <= 0:  # running the notebook again took the rest
            raise self._out_of_time()
        message = {
            "do": "evaluate",
            "name": name,
            "probe": probe,
            "seconds": seconds,
            "most": int(self._settings.output_mb * 2**20),
        }
        self._in_cell = None
        answer = self._ask(message, seconds, time.monotonic() + seconds * PATIENCE + GRACE)
        if "reply" not in answer and self._was_interrupted:
            raise Stopped("timeout")
        if "reply" not in answer:
            # The kernel, or the alarm that rings when a limit has passed many times over.
            ended_by = answer.get("ended_by")  # whatever a student's process says
            if isinstance(ended_by, int) and ended_by in (signal.SIGKILL, signal.SIGALRM):
                self._doubt.is_unexplained = True
            raise stop_by(answer.get("ended_by"))
        return answer

    def _run(self, names: list[str]) -> Report:
        settings = self._settings
        end = min(time.monotonic() + settings.notebook_seconds * PATIENCE, self._deadline)
        began, had_before = time.monotonic(), self._doubt.own_seconds
        while True:
            if self._channel is None:
                self._open()
            # What processes that had to be stopped have had is not given again; what they waited
            # for a processor is no loss.
            had = self._doubt.own_seconds - had_before
            left = max(GRACE, settings.notebook_seconds - had)
            message = {
                "do": "run",
                "cells": self._cells,
                "names": names,
                "skip": {str(index): stop.status for index, stop in self._stopped_cells.items()},
                "cell_seconds": settings.cell_seconds,
                "seconds": min(left, end - time.monotonic()),
            }
            self._in_cell = None
            try:
                answer = self._ask(message, left + GRACE / 2, end + GRACE)
            except Stopped as stopped:
                index = self._in_cell
                if index is None or index in self._stopped_cells or time.monotonic() >= end:
                    raise
                self._stopped_cells[index] = stopped
                self._restart()
                continue
            report = clean_report(answer.get("reply"), len(self._cells))
            if "timeout" in report["errors"] and self._host is not None:
                # All cells together had no time enough for one of them to have used its own up?
                with suppress(HostError):
                    self._doubt.look(self._host.own_time(began), settings.cell_seconds)
            for index, error in enumerate(report["errors"]):
                if error == "timeout":
                    self._stopped_cells.setdefault(index, Stopped("timeout"))
            return report

    def _ask(self, message: dict[str, object], seconds: float, deadline: float) -> Message:
        """Send a question and wait for the message with its nonce.

        ``seconds`` are of the child's own time, the deadline is on the clock.

        Raises:
            Stopped: after which the channel is closed.
        """
        assert self._channel is not None
        assert self._host is not None
        nonce = secrets.token_hex(16)
        self._was_interrupted = False
        self._limits = [_Limit(seconds)]
        notices = len(self._cells)
        try:
            self._channel.send({**message, "nonce": nonce}, deadline)
            while True:
                self._wait(deadline)
                before = self._channel.received
                answer: Message = self._channel.receive(
                    min(deadline, time.monotonic() + _MESSAGE_SECONDS)
                )
                if _carries(answer, nonce) and "cell" not in answer:
                    self._host.end_leftovers(only_orphans=message["do"] == "evaluate")
                    return answer
                self._stray_bytes += self._channel.received - before
                if _carries(answer, nonce) and notices > 0:
                    notices -= 1
                    self._note_cell(answer["cell"])
                    self._was_interrupted = False
                    cell = _Limit(self._settings.cell_seconds + GRACE / 2)
                    self._limits = [self._limits[0], cell]
                else:
                    self._strays += 1
                if self._strays > MAX_STRAY or self._stray_bytes > MAX_STRAY_BYTES:
                    raise wire.WireError("too many messages that answer nothing")
        except _GivenUp:
            self._close()
            raise Stopped("timeout") from None
        except Late:
            self._look_whether_it_was_slow()
            self._close()
            raise Stopped("timeout") from None
        except (EOFError, OSError, HostError, wire.WireError) as error:
            why = self._why_gone(error)
            if not isinstance(error, wire.WireError) and why in ("", BY_THE_SYSTEM):
                self._doubt.is_unexplained = True
            self._close()
            raise Stopped("killed", why) from None

    def _wait(self, deadline: float) -> None:
        """Wait for something to read from the child, or for news that it has gone.

        Raises:
            Late: at the deadline.
            _GivenUp: when the child has had its time and does not react.
        """
        assert self._channel is not None
        assert self._host is not None
        poll = select.poll()
        poll.register(self._channel, select.POLLIN)
        poll.register(self._host.control, select.POLLIN)
        while True:
            until = min(deadline, *(limit.due for limit in self._limits))
            ready = poll.poll(max(0.0, until - time.monotonic()) * 1000)
            if ready:
                break
            if time.monotonic() >= deadline:
                raise Late
            self._look_at_limits()
        if all(descriptor != self._channel.fileno() for descriptor, _ in ready):
            # What the child started may hold the channel open; the child itself has gone.
            raise EOFError

    def _look_at_limits(self) -> None:
        """Interrupt a child that has had its time, and later give it up.

        Raises:
            _GivenUp: when it does not react.
            EOFError: if it has ended.
        """
        assert self._host is not None
        for limit in self._limits:
            if time.monotonic() < limit.due:
                continue
            had = self._host.own_time(limit.since)
            if had is None:
                raise EOFError
            if had < limit.seconds:
                limit.due = time.monotonic() + limit.seconds - had
            elif self._was_interrupted:
                raise _GivenUp
            else:
                self._was_interrupted = True
                self._host.interrupt(only_forks=self._in_cell is None)
                limit.due, limit.since = time.monotonic() + GRACE, time.monotonic()
                limit.seconds = GRACE

    def _check_deadline(self) -> None:
        if time.monotonic() >= self._deadline:
            raise self._out_of_time()

    def _out_of_time(self) -> Stopped:
        self._doubt.ran_out = True
        return out_of_time()

    def _note_cell(self, index: object) -> None:
        if type(index) is int and 0 <= index < len(self._cells):
            self._in_cell = index

    def _look_whether_it_was_slow(self) -> None:
        """After the clock's limit: whether the child had much of its own time."""
        assert self._host is not None
        whole = self._limits[0]
        try:
            self._doubt.look(self._host.own_time(whole.since), whole.seconds)
        except HostError:
            self._doubt.is_unexplained = True

    def _why_gone(self, error: Exception) -> str:
        if isinstance(error, wire.WireError):
            return "it sent data that is no answer"
        try:
            return (self._host.why_gone(1.0) if self._host else None) or ""
        except OSError:
            return ""

    def _restart(self) -> None:
        """Begin anew after a failure, a limited number of times.

        Raises:
            Stopped: if it was tried too often.
        """
        if self._restarts_left == 0:
            raise Stopped("killed", N_("the notebook had to be stopped too often"))
        self._restarts_left -= 1
        self._open()

    def _open(self) -> None:
        for last_try in (False, True):
            self._host = self._take_host()
            try:
                self._channel = self._host.open(limits(self._settings), self._seed)
                self._strays, self._stray_bytes = 0, 0
                self._opened = time.monotonic()
                return
            except HostError:
                self._host.stop()  # the next one is new
                if last_try:
                    raise

    def _close(self) -> None:
        if self._channel is None or self._host is None:
            return
        self._channel.close()
        self._channel = None
        try:
            self._doubt.own_seconds += self._host.close()
        except HostError:
            self._host.stop()
        self._doubt.open_seconds += time.monotonic() - self._opened


class _GivenUp(Late):
    """The child has had all of its own time, and was interrupted in vain."""


@dataclass
class _Limit:
    """Seconds of the child's own time.

    Before ``due`` they cannot have passed, if it is one process that sleeps or works.
    """

    seconds: float
    since: float = field(default_factory=time.monotonic)
    due: float = 0.0

    def __post_init__(self) -> None:
        self.due = self.since + self.seconds


def _mentions(cell: str, name: str) -> bool:
    return re.search(rf"\b{re.escape(name)}\b", cell) is not None


def _carries(answer: object, nonce: str) -> bool:
    """Whether a message is the answer to the question with this nonce.

    Student code may have put an array in the nonce's place, and that cannot be compared.
    """
    given = answer.get("nonce") if isinstance(answer, dict) else None
    return isinstance(given, str) and given == nonce
