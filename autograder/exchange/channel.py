"""A socket that carries whole messages, each with an absolute deadline."""

from __future__ import annotations

import contextlib
import select
import socket
import time

from autograder.exchange import wire
from autograder.exchange.messages import Value

_CHUNK = 2**18


class Late(Exception):
    """The deadline passed."""


class Channel:
    """Sends and receives messages of `autograder.exchange.wire`.

    ``max_json`` and ``max_arrays`` cap what is received; memory grows only with what has arrived.
    """

    def __init__(
        self,
        sock: socket.socket,
        max_json: int = wire.MAX_JSON,
        max_arrays: int = wire.MAX_ARRAYS,
    ) -> None:
        self._socket = sock
        self._max_json, self._max_arrays = max_json, max_arrays
        self.received = 0  # bytes, in all

    def fileno(self) -> int:
        """The descriptor, for `select`."""
        return self._socket.fileno()

    def send(self, message: object, deadline: float | None = None, most: int | None = None) -> None:
        """Send one message; ``most`` is as in `wire.encode`.

        Raises:
            wire.TooLarge: if it is more than the other side takes.
            Late: if the other side does not take it in time.
            OSError: if there is no other side any more.
        """
        data = memoryview(wire.encode(message, most))
        if deadline is None:
            self._socket.sendall(data)
            return
        while data:
            self._wait(deadline, to_write=True)
            with contextlib.suppress(BlockingIOError):
                data = data[self._socket.send(data, socket.MSG_DONTWAIT) :]

    def receive(self, deadline: float | None = None) -> Value:
        """Receive one message.

        Raises:
            Late: if it is not there in time, however slowly it comes.
            EOFError: if the other side closed.
            wire.WireError: if what came is no message.
        """
        return wire.read_message(
            lambda count: self._read_exactly(count, deadline), self._max_json, self._max_arrays
        )

    def close(self) -> None:
        """Close this end."""
        self._socket.close()

    def _read_exactly(self, count: int, deadline: float | None) -> bytes:
        data = bytearray()
        while len(data) < count:
            self._wait(deadline)
            try:
                part = self._socket.recv(min(count - len(data), _CHUNK))
            except ConnectionError:
                part = b""
            if not part:
                raise EOFError
            data += part
            self.received += len(part)
        return bytes(data)

    def _wait(self, deadline: float | None, to_write: bool = False) -> None:
        if deadline is None:
            return
        left = deadline - time.monotonic()
        # poll, because select cannot take descriptors above 1023
        poll = select.poll()
        poll.register(self._socket, select.POLLOUT if to_write else select.POLLIN)
        if left <= 0 or not poll.poll(left * 1000):
            raise Late
