"""Questions to one child: each has its own nonce, and a time that is kept on the trusted side."""

from __future__ import annotations

import secrets
import select
import time
from dataclasses import dataclass, field

from autograder.course import Settings
from autograder.exchange import wire
from autograder.exchange.channel import Late
from autograder.exchange.messages import Message
from autograder.sandbox.host import Host
from autograder.sandbox.machine_to_blame import Doubt
from autograder.sandbox.notebook_limits import limits
from autograder.sandbox.stop_errors import BY_THE_SYSTEM, Stopped
from autograder.sandbox.zygote_start import HostError

GRACE = 1.0  # seconds between the child's own limit and the one kept here
# What may come from one process without answering anything before its channel counts as broken:
# reading it costs the grader time, which belongs to all submissions.
MAX_STRAY = 16  # messages; a process that a response forked and forgot may well send one
MAX_STRAY_BYTES = 2**20  # notices that a cell begins included
_MESSAGE_SECONDS = 20.0  # for the rest of a message of which the beginning has come


class Conversation:
    """Asks the child that ``host`` forks for it, until an answer fails to come.

    Raises:
        HostError: if the host does not answer; then `Host.stop` it.
    """

    def __init__(self, host: Host, settings: Settings, seed: int, doubt: Doubt) -> None:
        self._host, self._settings, self._doubt = host, settings, doubt
        self._channel = host.open(limits(settings), seed)
        self._opened = time.monotonic()
        self._strays, self._stray_bytes = 0, 0
        self._limits: list[_Limit] = []
        self.is_open = True
        self.in_cell: int | None = None  # the last of which the child said that it begins
        self.was_interrupted = False

    def ask(
        self, message: dict[str, object], seconds: float, deadline: float, cells: int = 0
    ) -> Message:
        """Send a question and wait for the message with its nonce.

        ``seconds`` are of the child's own time, the deadline is on the clock. Of as many ``cells``
        the child may say that it begins one.

        Raises:
            Stopped: after which the conversation is closed.
        """
        nonce = secrets.token_hex(16)
        self.in_cell, self.was_interrupted = None, False
        self._limits = [_Limit(seconds)]
        notices = cells
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
                    self._note_cell(answer["cell"], cells)
                    self.was_interrupted = False
                    cell = _Limit(self._settings.cell_seconds + GRACE / 2)
                    self._limits = [self._limits[0], cell]
                else:
                    self._strays += 1
                if self._strays > MAX_STRAY or self._stray_bytes > MAX_STRAY_BYTES:
                    raise wire.WireError("too many messages that answer nothing")
        except _GivenUp:
            self.close()
            raise Stopped("timeout") from None
        except Late:
            self._look_whether_it_was_slow()
            self.close()
            raise Stopped("timeout") from None
        except (EOFError, OSError, HostError, wire.WireError) as error:
            why = self._why_gone(error)
            if not isinstance(error, wire.WireError) and why in ("", BY_THE_SYSTEM):
                self._doubt.is_unexplained = True
            self.close()
            raise Stopped("killed", why) from None

    def own_time(self, since: float) -> float | None:
        """The child's own seconds since a moment; None if it has ended, or nobody can say."""
        try:
            return self._host.own_time(since)
        except HostError:
            return None

    def close(self) -> None:
        """End the child and all that it started; what it had is kept in the doubt."""
        if not self.is_open:
            return
        self.is_open = False
        self._channel.close()
        try:
            self._doubt.own_seconds += self._host.close()
        except HostError:
            self._host.stop()
        self._doubt.open_seconds += time.monotonic() - self._opened

    def _wait(self, deadline: float) -> None:
        """Wait for something to read from the child, or for news that it has gone.

        Raises:
            Late: at the deadline.
            _GivenUp: when the child has had its time and does not react.
        """
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
        for limit in self._limits:
            if time.monotonic() < limit.due:
                continue
            had = self._host.own_time(limit.since)
            if had is None:
                raise EOFError
            if had < limit.seconds:
                limit.due = time.monotonic() + limit.seconds - had
            elif self.was_interrupted:
                raise _GivenUp
            else:
                self.was_interrupted = True
                self._host.interrupt(only_forks=self.in_cell is None)
                limit.due, limit.since = time.monotonic() + GRACE, time.monotonic()
                limit.seconds = GRACE

    def _note_cell(self, index: object, cells: int) -> None:
        if type(index) is int and 0 <= index < cells:
            self.in_cell = index

    def _look_whether_it_was_slow(self) -> None:
        """After the clock's limit: whether the child had much of its own time."""
        whole = self._limits[0]
        try:
            self._doubt.look(self._host.own_time(whole.since), whole.seconds)
        except HostError:
            self._doubt.is_unexplained = True

    def _why_gone(self, error: Exception) -> str:
        if isinstance(error, wire.WireError):
            return "it sent data that is no answer"
        try:
            return self._host.why_gone(1.0) or ""
        except OSError:
            return ""


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


def _carries(answer: object, nonce: str) -> bool:
    """Whether a message is the answer to the question with this nonce.

    Student code may have put an array in the nonce's place, and that cannot be compared.
    """
    given = answer.get("nonce") if isinstance(answer, dict) else None
    return isinstance(given, str) and given == nonce
