"""A class to be graded on a cluster, its workers, and the marks that came out."""

from __future__ import annotations

import os
import random
import signal
import socket
import sqlite3
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from contextlib import closing
from pathlib import Path

from autograder.sandbox.processes import descendants
from tests.classroom import hand_in, make_course, stored

REPOSITORY = Path(__file__).parents[2]
LIMITS = """
[project]
name = "orchard"
version = "0.1"

[tool.autograder]
notebook_seconds = 60
cell_seconds = 1
question_seconds = 30
memory_mb = 300
"""
HONEST: list[dict[str, str]] = [
    {},
    {"Q2": "trees = 7"},
    {"Q3": "import sympy as sp\nw, l = sp.symbols('w l')\nhedge = w + l"},
    {"Q4": "import numpy as np\ndef heaviest(w):\n    return float(np.random.choice(w))"},
    {"Q4": "def heaviest(w):\n    return min(w)"},
]
HOSTILE: list[dict[str, str]] = [
    {"Q2": "while True: pass\ntrees = 12"},
    {"Q4": "import ctypes\ndef heaviest(w):\n    ctypes.string_at(0)"},
    {"Q4": "def heaviest(w):\n    return bytearray(10**10)"},
    {"Q2": "import os\nwhile True:\n    try: os.fork()\n    except OSError: pass"},
    {"Q2": "import os\nos._exit(0)\ntrees = 12"},
    {"Q4": "def heaviest(w):\n    raise SystemExit('leaked', w)"},
    {"Q2": "import os, signal\nos.kill(-1, signal.SIGKILL)\ntrees = 12"},
    {"Q2": "trees = 10**400"},
    {"Q4": "class Liar(float):\n    def __eq__(self, other): return True\n"
           "def heaviest(w): return Liar(1)"},
    {"Q2": "import sys\nsys.stdout.write('x' * 10**8)\ntrees = 12"},
]  # fmt: skip


def make_class(root: Path, students: int, hostile: int) -> None:
    """A course, and submissions of which every so many is hostile."""
    make_course(root / "course")
    (root / "course/pyproject.toml").write_text(LIMITS)
    every = max(1, students // max(1, hostile))
    for number in range(students):
        attacks = hostile and number % every == every // 2 and number // every < hostile
        responses = HOSTILE[number // every % 10] if attacks else HONEST[number % len(HONEST)]
        hand_in(root / "work", f"student{number:04}", **responses)


def start(root: Path, out: str, *more: str, **environment: str) -> subprocess.Popen[str]:
    """Grade the class in a process of its own."""
    command = [sys.executable, "-m", "autograder", "--course", "course", "grade", "work"]
    return subprocess.Popen(
        [*command, "--out", out, "--seed", "7", *more],
        cwd=root,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
        env={**os.environ, "PYTHONPATH": str(REPOSITORY), **environment},
        # A shell's background job ignores Ctrl-C and would hand that on.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )


def marks(path: Path) -> list[tuple[object, ...]]:
    """Every mark in a gradebook, to the last character, without when and how fast it was given."""
    with closing(sqlite3.connect(path)) as db:
        return db.execute("SELECT student, question, mark FROM mark ORDER BY 1, 2").fetchall()


def workers(coordinator: int) -> list[int]:
    """The worker processes of ``--cluster local:N``."""
    found = []
    for process in descendants(coordinator):
        try:
            command = Path(f"/proc/{process}/cmdline").read_bytes()
        except OSError:
            continue
        if b"spawn_main" in command:
            found.append(process)
    return found


def wait_until(true: Callable[[], object], seconds: float = 120.0) -> None:
    """Wait for something to become true; if it does not in this time, it never will."""
    deadline = time.monotonic() + seconds
    while not true():
        assert time.monotonic() < deadline, "it did not happen"
        time.sleep(0.05)


def kill_workers_at_random(
    process: subprocess.Popen[str], gradebook: Path, students: int, times: int, seed: int
) -> int:
    """Kill a worker with -9 whenever another random number of submissions is stored."""
    rng = random.Random(seed)
    killed = 0
    for count in sorted(rng.sample(range(1, students - 3), times)):
        wait_until(lambda count=count: stored(gradebook) >= count or process.poll() is not None)
        alive = workers(process.pid)
        if alive and process.poll() is None:
            os.kill(rng.choice(alive), signal.SIGKILL)
            killed += 1
    return killed


def free_port() -> int:
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return int(listener.getsockname()[1])


class Lab:
    """A scheduler and workers, started as people start them, each worker with its own oddities."""

    def __init__(
        self, root: Path, host: str = "127.0.0.1", scheme: str = "tcp", **environment: str
    ) -> None:
        self.root, self.host, self.environment = root, host, environment
        self.port = free_port()
        self.address = f"{scheme}://{host}:{self.port}"
        self.processes: list[subprocess.Popen[bytes]] = []

    def scheduler(self, *more: str, on: Sequence[str] = ()) -> subprocess.Popen[bytes]:
        """``on`` stands before the command, to have it run on another host."""
        where = ["--host", self.host, "--port", str(self.port), "--no-dashboard", *more]
        process = self._start("distributed.cli.dask_scheduler", *where, on=on)
        wait_until(lambda: self._answers() or process.poll() is not None)
        assert process.poll() is None
        return process

    def worker(
        self, name: str, odd: str = "", on: Sequence[str] = (), **environment: str
    ) -> subprocess.Popen[bytes]:
        """A worker with one slot; ``odd`` is code that it runs before anything else."""
        if odd:
            folder = self.root / f"odd-{name}"
            folder.mkdir()
            (folder / "sitecustomize.py").write_text(odd)
            environment["PYTHONPATH"] = f"{folder}:{REPOSITORY}"
        return self._start(
            "distributed.cli.dask_worker",
            *(self.address, "--name", name, "--nthreads", "1", "--no-nanny", "--no-dashboard"),
            on=on,
            **environment,
        )

    def wait_for_workers(self, count: int) -> None:
        """Wait until this many have joined, however long their machine takes to start them."""
        from distributed import Client

        with Client(self.address, set_as_default=False) as client:
            client.wait_for_workers(count, timeout=120)

    def stop(self) -> None:
        for process in self.processes:
            process.kill()
            process.wait()

    def _start(
        self, module: str, *arguments: str, on: Sequence[str] = (), **environment: str
    ) -> subprocess.Popen[bytes]:
        log = (self.root / f"{module}-{len(self.processes)}.log").open("wb")
        process = subprocess.Popen(
            [*on, sys.executable, "-m", module, *arguments],
            cwd=self.root / "course",
            env={**os.environ, "PYTHONPATH": str(REPOSITORY), **self.environment, **environment},
            stdout=log,
            stderr=log,
        )
        log.close()
        self.processes.append(process)
        return process

    def _answers(self) -> bool:
        with socket.socket() as line:
            return line.connect_ex((self.host, self.port)) == 0
