"""The notebook's line to the process that marks."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from typing import Any

from autograder.course import Course
from autograder.errors import AutograderError, CourseError
from autograder.marking.mark import Mark
from autograder.sandbox import wire

_client: MarkerClient | None = None


def marker_for(course: Course) -> MarkerClient | None:
    """The marker of this kernel, started at the first call; None where there is no key."""
    global _client
    if not course.has_key:
        return None
    if _client is None or _client.course is not course or not _client.alive:
        _client = MarkerClient(course)
    return _client


class MarkerClient:
    """Asks a process of its own for probes and marks."""

    def __init__(self, course: Course) -> None:
        self.course = course
        self._lock = threading.Lock()
        environment = {**os.environ, "AUTOGRADER_COURSE": str(course.root)}
        self._process = subprocess.Popen(
            [sys.executable, "-m", "autograder.student.marker_process"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            cwd=course.root,
            env=environment,
            # Interrupting the kernel must not end the marker.
            start_new_session=True,
        )

    @property
    def alive(self) -> bool:
        """Whether the process still runs."""
        return self._process.poll() is None

    def probe(self, id: str) -> dict[str, Any]:
        """What the kernel has to evaluate for a question."""
        sent: dict[str, Any] = self._ask({"do": "probe", "question": id})["sent"]
        return sent

    def mark(self, id: str, response: Any, understood: str = "") -> Mark:
        """The mark of what came out."""
        reply = self._ask(
            {"do": "mark", "question": id, "response": response, "understood": understood}
        )
        return Mark.from_dict(reply["mark"])

    def _ask(self, message: dict[str, Any]) -> dict[str, Any]:
        stdin, stdout = self._process.stdin, self._process.stdout
        assert stdin is not None
        assert stdout is not None

        def read_exactly(count: int) -> bytes:
            data = stdout.read(count)
            if len(data) < count:
                raise EOFError
            return data

        with self._lock:
            try:
                stdin.write(wire.encode(message))
                stdin.flush()
                reply = wire.read_message(read_exactly)
            except (EOFError, OSError, wire.WireError):
                self._end()
                raise AutograderError(
                    "Marking stopped unexpectedly; run the cell again. If that does not help, "
                    "run `autograder check` in the course's folder."
                ) from None
            except BaseException:
                # An interrupt in the middle of a message: the next one would read its rest.
                self._end()
                raise
        if "error" in reply:
            raise CourseError(reply["error"])
        return dict(reply)

    def _end(self) -> None:
        """Kill the process and wait for it, so that `alive` says so at once."""
        self._process.kill()
        self._process.wait()
