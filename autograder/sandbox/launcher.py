"""The trusted side of student code: starts the process it runs in, asks it, and ends it.

`Sandbox` and `Session` are all that the rest of the autograder knows of isolation. Student code never runs in
this process, and only plain data comes back.
"""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
from pathlib import Path
from typing import Any

from autograder.course import Course
from autograder.sandbox import wire

VISIBLE = ("autograder", "data", "notebooks")


class Stopped(Exception):
    """The student's process did not answer: ``status`` is ``timeout`` or ``killed``."""

    def __init__(self, status: str) -> None:
        super().__init__(status)
        self.status = status


class Sandbox:
    """Where student code runs, one for each worker slot; start it from the main thread.

    ``isolation`` names what keeps student code in, for reports.
    """

    isolation = "a separate process"

    def __init__(self, course: Course) -> None:
        self._course = course

    def __enter__(self) -> Sandbox:
        return self

    def __exit__(self, *exception: object) -> None:
        """Nothing is kept between sessions."""

    def session(self) -> Session:
        """A fresh process for one notebook of one submission."""
        return Session(self._course)


class Session:
    """One notebook of one submission, in a process of its own.

    Use it as a context manager. After a response has hung or crashed the process, the next question
    gets a new one in which the cells are run again, so that the failure costs one question.
    """

    def __init__(self, course: Course) -> None:
        self._course = course
        self._process: subprocess.Popen[bytes] | None = None
        self._cells: list[str] = []

    def __enter__(self) -> Session:
        self._folder = Path(tempfile.mkdtemp(prefix="autograder-"))
        stage(self._course.root, self._folder)
        return self

    def __exit__(self, *exception: object) -> None:
        self._end()
        shutil.rmtree(self._folder, ignore_errors=True)

    def run(self, cells: list[str], names: list[str]) -> dict[str, Any]:
        """Run the cells; ``names`` are the variables whose understood value is wanted.

        Raises:
            Stopped: if the notebook takes too long or its process dies.
        """
        self._cells = cells
        seconds = self._course.settings.notebook_seconds
        return self._ask({"do": "run", "cells": cells, "names": names}, seconds)

    def evaluate(self, name: str, probe: dict[str, Any]) -> dict[str, Any]:
        """Evaluate the response held by ``name``.

        Raises:
            Stopped: if it takes too long or its process dies.
        """
        if self._process is None:
            self.run(self._cells, [])
        message = {"do": "evaluate", "name": name, "probe": probe}
        return self._ask(message, self._course.settings.question_seconds)

    def _ask(self, message: dict[str, Any], seconds: float) -> dict[str, Any]:
        if self._process is None:
            self._start()
        process = self._process
        assert process is not None
        assert process.stdin is not None
        assert process.stdout is not None
        late = threading.Event()

        def give_up() -> None:
            late.set()
            _kill(process)

        def read_exactly(count: int) -> bytes:
            assert process.stdout is not None
            data = process.stdout.read(count)
            if len(data) < count:
                raise EOFError
            return data

        watchdog = threading.Timer(seconds, give_up)
        watchdog.start()
        try:
            process.stdin.write(wire.encode(message))
            process.stdin.flush()
            reply = wire.read_message(read_exactly)
            if not isinstance(reply, dict):
                raise wire.WireError("not a reply")
            return reply
        except (EOFError, OSError, wire.WireError):
            self._end()
            raise Stopped("timeout" if late.is_set() else "killed") from None
        finally:
            watchdog.cancel()

    def _start(self) -> None:
        work = self._folder / "notebooks"
        responses = self._folder / "responses"
        shutil.rmtree(responses, ignore_errors=True)
        responses.mkdir()
        environment = {
            "PATH": os.defpath,
            "HOME": str(self._folder),
            "LANG": "C.UTF-8",
            "MPLBACKEND": "agg",
            "MPLCONFIGDIR": str(self._folder),
            "IPYTHONDIR": str(self._folder),
            "OMP_NUM_THREADS": "1",
            "OPENBLAS_NUM_THREADS": "1",
            "PYTHONPATH": str(self._folder),
            "AUTOGRADER_COURSE": str(self._folder),
            "AUTOGRADER_RESPONSES": str(responses),
            "AUTOGRADER_MEMORY_MB": str(self._course.settings.memory_mb),
        }
        if sys.platform == "win32":
            environment["SYSTEMROOT"] = os.environ["SYSTEMROOT"]
        self._process = subprocess.Popen(
            [sys.executable, "-m", "autograder.sandbox.worker"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            cwd=work,
            env=environment,
            start_new_session=True,
        )

    def _end(self) -> None:
        if self._process is None:
            return
        _kill(self._process)
        for stream in (self._process.stdin, self._process.stdout):
            if stream is not None:
                try:
                    stream.close()
                except OSError:
                    pass
        self._process.wait()
        self._process = None


def stage(root: Path, folder: Path) -> None:
    """Lay out what student code may see: the course without its solutions."""
    for name in VISIBLE:
        source = root / name
        if not source.exists():
            continue
        if name == "notebooks":
            # Copied, because it is the working folder: a student's files never reach the course.
            shutil.copytree(
                source,
                folder / name,
                ignore=shutil.ignore_patterns("responses", "*.ipynb", "*.zip", "__pycache__"),
            )
        else:
            _link(source, folder / name)
    if (root / "pyproject.toml").exists():
        shutil.copy(root / "pyproject.toml", folder)


def _link(source: Path, target: Path) -> None:
    try:
        target.symlink_to(source, target_is_directory=True)
    except OSError:  # Windows allows links only to administrators
        shutil.copytree(source, target, ignore=shutil.ignore_patterns("__pycache__"))


def _kill(process: subprocess.Popen[bytes]) -> None:
    """End the process and whatever it started."""
    try:
        if sys.platform == "win32":
            process.kill()
        else:
            os.killpg(process.pid, signal.SIGKILL)
    except (ProcessLookupError, PermissionError):
        pass
