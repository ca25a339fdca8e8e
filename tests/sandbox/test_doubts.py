"""What stops a submission is the student's, unless neither its time nor its memory explains it."""

import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from attacks import CASE, LIMITS

from autograder.cli import main
from autograder.sandbox.launcher import Sandbox, Stopped
from autograder.sandbox.machine_to_blame import Doubt
from autograder.sandbox.processes import descendants
from autograder.sandbox.session import Session
from tests.classroom import hand_in, make_course
from tests.toy import Toy

SLEEPS = "import time\ndef double(x):\n    time.sleep(60)"
LOOPS = "def double(x):\n    while True: pass"


def stop_of(sandbox: Sandbox, code: str) -> tuple[str, Doubt]:
    doubt = Doubt()
    with Session(sandbox._take_host, LIMITS, 1, doubt=doubt) as session:
        session.run([code], [])
        with pytest.raises(Stopped) as stopped:
            session.evaluate("double", CASE)
    return stopped.value.status, doubt


@pytest.mark.parametrize("code", [SLEEPS, LOOPS])
def test_who_sleeps_or_loops_for_ever_is_stopped_for_good(best_sandbox, code):
    status, doubt = stop_of(best_sandbox, code)
    assert status == "timeout"
    assert not doubt.is_doubtful


def test_a_clock_that_runs_out_before_the_students_own_time_leaves_a_doubt(
    best_sandbox, monkeypatch
):
    # As where a machine is so loaded that the process gets no turn.
    monkeypatch.setattr("autograder.sandbox.session.PATIENCE", 0)
    status, doubt = stop_of(best_sandbox, LOOPS)
    assert status == "timeout"
    assert doubt.is_doubtful


@pytest.mark.skipif(os.geteuid() != 0, reason="the sandbox has a user of its own")
def test_who_is_ended_by_the_system_leaves_a_doubt(best_sandbox):
    ended = threading.Event()

    def end() -> None:
        """End the youngest process, as the kernel does where memory runs out."""
        time.sleep(0.3)
        while not ended.is_set():
            below = descendants(best_sandbox._host._process.pid)
            if len(below) >= 2:
                os.kill(max(below), signal.SIGKILL)
                return
            time.sleep(0.05)

    thread = threading.Thread(target=end)
    doubt = Doubt()
    with Session(best_sandbox._take_host, LIMITS, 1, doubt=doubt) as session:
        session.run([SLEEPS], [])
        thread.start()
        with pytest.raises(Stopped) as stopped:
            session.evaluate("double", CASE)
    ended.set()
    thread.join()
    assert stopped.value.status == "killed"
    assert doubt.is_doubtful


def test_a_submission_that_ran_out_of_time_is_in_doubt_only_where_it_had_little_of_it():
    assert Doubt(ran_out=True, open_seconds=600, own_seconds=20).is_doubtful
    assert not Doubt(ran_out=True, open_seconds=600, own_seconds=590).is_doubtful
    assert not Doubt(open_seconds=600, own_seconds=20).is_doubtful


@contextmanager
def a_busy_machine() -> Iterator[None]:
    """Eight processes that never rest."""
    command = [sys.executable, "-c", "while True: pass"]
    busy = [subprocess.Popen(command) for _ in range(8)]
    try:
        yield
    finally:
        for process in busy:
            process.kill()
            process.wait()


@pytest.mark.hostile
@pytest.mark.skipif("AUTOGRADER_HOSTILE" not in os.environ, reason="AUTOGRADER_HOSTILE is not set")
def test_the_same_class_gets_the_same_marks_on_a_busy_machine(tmp_path: Path):
    make_course(tmp_path / "course")
    limits = "notebook_seconds = 20\ncell_seconds = 3\nquestion_seconds = 3\n"
    Toy(tmp_path / "course").set(limits)
    for name in ("ada", "bob", "eve", "zoe"):
        hand_in(tmp_path / "work", name)
    hand_in(tmp_path / "work", "loops", Q4="def heaviest(w):\n    while True: pass")
    hand_in(tmp_path / "work", "sleeps", Q4="import time\ndef heaviest(w):\n    time.sleep(99)")
    # Uses a second of a processor for each of a few cases, far below the limit.
    slow = "import time\ndef heaviest(w):\n    end = time.process_time() + 0.05\n"
    slow += "    while time.process_time() < end: pass\n    return max(w)"
    hand_in(tmp_path / "work", "slow", Q4=slow)
    forks = "import os\nfor _ in range(5): os.fork()\nwhile True: pass"
    hand_in(tmp_path / "work", "spins", Q2=forks)

    def grade(name: str) -> str:
        arguments = ["grade", str(tmp_path / "work"), "--out", str(tmp_path / name), "--seed", "1"]
        assert main(["--course", str(tmp_path / "course"), *arguments]) == 0
        return (tmp_path / name / "grades.csv").read_text()

    idle = grade("idle")
    with a_busy_machine():
        busy = grade("busy")
    assert busy == idle
    assert {f",{name}," for name in ("ada", "slow")} <= {
        f",{line.split(',')[0]}," for line in idle.splitlines() if ",10,10,graded" in line
    }
