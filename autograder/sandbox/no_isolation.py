"""Student code in a plain process with the instructor's rights, for ``--no-sandbox`` only."""

from __future__ import annotations

import math
import os
import shutil
import signal
import subprocess
import sys
import threading
import time
from contextlib import suppress
from pathlib import Path

from autograder.course import Course
from autograder.course.folders import VISIBLE_FILES
from autograder.exchange import wire
from autograder.exchange.messages import Evaluation, Message, Report
from autograder.exchange.replies import clean_evaluation, clean_report
from autograder.sandbox.empty_folder import remove
from autograder.sandbox.own_folder import OwnFolder
from autograder.sandbox.stop_errors import Stopped, out_of_time

VISIBLE = ("autograder", "data", "notebooks")


class PlainSession:
    """One notebook of one submission, in a process of its own.

    After a response has hung or crashed the process, the next question gets a new one in which the
    cells are run again, so that the failure costs one question.
    """

    def __init__(self, course: Course, deadline: float = math.inf) -> None:
        self._course = course
        self._deadline = deadline
        self._process: subprocess.Popen[bytes] | None = None
        self._cells: list[str] = []

    def __enter__(self) -> PlainSession:
        self._own_folder = OwnFolder()
        self._folder = self._own_folder.path
        _stage(self._course.root, self._folder)
        return self

    def __exit__(self, *exception: object) -> None:
        self.stop()
        self._own_folder.remove()

    def run(self, cells: list[str], names: list[str]) -> Report:
        """As `Session.run`."""
        self._cells = cells
        settings = self._course.settings
        message = {
            "do": "run",
            "cells": cells,
            "names": names,
            "cell_seconds": settings.cell_seconds,
            "seconds": settings.notebook_seconds,
        }
        return clean_report(self._ask(message, settings.notebook_seconds + 2), len(cells))

    def evaluate(self, name: str, probe: Message) -> Evaluation:
        """As `Session.evaluate`."""
        if self._process is None:
            self.run(self._cells, [])
        message = {"do": "evaluate", "name": name, "probe": probe}
        return clean_evaluation(self._ask(message, self._course.settings.question_seconds))

    def stop(self) -> None:
        """End the process and whatever it started."""
        if self._process is None:
            return
        _kill(self._process)
        for stream in (self._process.stdin, self._process.stdout):
            if stream is not None:
                with suppress(OSError):
                    stream.close()
        self._process.wait()
        self._process = None

    def _ask(self, message: Message, seconds: float) -> Message:
        seconds = min(seconds, self._deadline - time.monotonic())
        if seconds <= 0:
            raise out_of_time()
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

        watchdog = threading.Timer(seconds, give_up)
        watchdog.start()
        try:
            process.stdin.write(wire.encode(message))
            process.stdin.flush()
            reply = wire.read_stream(process.stdout)
            if not isinstance(reply, dict):
                raise wire.WireError("not a reply")
            return reply
        except (EOFError, OSError, wire.WireError):
            self.stop()
            raise Stopped("timeout" if late.is_set() else "killed") from None
        finally:
            watchdog.cancel()

    def _start(self) -> None:
        work = self._folder / "notebooks"
        responses = self._folder / "responses"
        remove(responses)
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
            [sys.executable, "-m", "autograder.sandbox.inside.plain_process"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            cwd=work,
            env=environment,
            start_new_session=True,
        )


def _stage(root: Path, folder: Path) -> None:
    """Lay out what student code is shown: the course without its solutions."""
    for name in VISIBLE:
        source = Path(__file__).parents[1] if name == "autograder" else root / name
        if name == "notebooks":
            # Copied, because it is the working folder: a student's files never reach the course.
            (folder / name).mkdir()
            if source.is_dir():
                ignored = shutil.ignore_patterns("responses", "*.ipynb", "*.zip", "__pycache__")
                shutil.copytree(source, folder / name, ignore=ignored, dirs_exist_ok=True)
        elif source.is_dir():
            _link(source, folder / name)
    for name in VISIBLE_FILES:
        if (root / name).exists():
            shutil.copy(root / name, folder)


def _link(source: Path, target: Path) -> None:
    try:
        target.symlink_to(source, target_is_directory=True)
    except OSError:  # Windows allows links only to administrators
        shutil.copytree(source, target, ignore=shutil.ignore_patterns("__pycache__"))


def _kill(process: subprocess.Popen[bytes]) -> None:
    """End the process and whatever it started."""
    with suppress(ProcessLookupError, PermissionError):
        if sys.platform == "win32":
            process.kill()
        else:
            os.killpg(process.pid, signal.SIGKILL)
