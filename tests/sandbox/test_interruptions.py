"""A run that is stopped: nothing is left running, and going on ends as if it had not been."""

import os
import random
import signal
import sqlite3
import subprocess
import sys
import time
from contextlib import closing
from pathlib import Path

import pytest

from autograder.sandbox.processes import descendants
from tests.classroom import hand_in, make_course

STUDENTS = 8


@pytest.fixture(scope="module")
def root(tmp_path_factory) -> Path:
    root = tmp_path_factory.mktemp("interrupted")
    make_course(root / "course")
    for number in range(STUDENTS):
        late = f"import time\ntime.sleep(0.2)\ntrees = {12 if number % 2 else 7}"
        chance = "import numpy as np\ndef heaviest(w):\n    return float(np.random.choice(w))"
        hand_in(
            root / "work", f"student{number}", Q2=late, **({"Q4": chance} if number % 3 else {})
        )
    return root


def start(root: Path, out: str) -> subprocess.Popen[str]:
    command = [sys.executable, "-m", "autograder", "--course", "course", "grade", "work"]
    return subprocess.Popen(
        [*command, "--out", out, "--seed", "7", "--jobs", "2"],
        cwd=root,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        # A shell's background job ignores Ctrl-C and would hand that on.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )


def marks(path: Path) -> list[tuple[object, ...]]:
    """Every mark in a gradebook, without when and how fast it was given."""
    with closing(sqlite3.connect(path)) as db:
        columns = [name for _, name, *_ in db.execute("PRAGMA table_info(mark)")]
        kept = [name for name in columns if not name.endswith(("_at", "seconds", "run"))]
        return sorted(db.execute(f"SELECT {', '.join(kept)} FROM mark"), key=repr)


def has_marks(path: Path) -> bool:
    """Whether somebody has been graded, so that a run is in the midst of it."""
    if not path.exists():
        return False
    try:
        with closing(sqlite3.connect(path)) as db:
            return bool(db.execute("SELECT count(*) FROM mark").fetchone()[0])
    except sqlite3.OperationalError:  # its tables are being made
        return False


def is_running(process: int) -> bool:
    try:
        return Path(f"/proc/{process}/stat").read_bytes().rpartition(b")")[2].split()[0] != b"Z"
    except OSError:
        return False


def wait_until_gone(processes: list[int]) -> list[int]:
    deadline = time.monotonic() + 10
    while (left := [p for p in processes if is_running(p)]) and time.monotonic() < deadline:
        time.sleep(0.05)
    return left


@pytest.fixture(scope="module")
def uninterrupted(root) -> list[tuple[object, ...]]:
    process = start(root, "whole")
    assert process.wait(120) == 0
    return marks(root / "whole/gradebook.db")


def test_a_run_killed_at_random_moments_ends_with_the_same_marks(root, uninterrupted):
    rng = random.Random(4)
    for _ in range(3):
        process = start(root, "killed")
        time.sleep(rng.uniform(0.5, 6))
        below = descendants(process.pid)
        os.kill(process.pid, signal.SIGKILL)
        process.wait()
        assert wait_until_gone(below) == []
    process = start(root, "killed")
    assert process.wait(120) == 0
    assert len(uninterrupted) > STUDENTS
    assert marks(root / "killed/gradebook.db") == uninterrupted


def test_what_was_graded_is_not_run_again(root, uninterrupted):
    before = marks(root / "whole/gradebook.db")
    process = start(root, "whole")
    seen: set[int] = set()
    while process.poll() is None:
        seen |= set(descendants(process.pid))
        time.sleep(0.01)
    assert process.returncode == 0
    assert not seen  # no sandbox was even started
    assert marks(root / "whole/gradebook.db") == before


def test_ctrl_c_stops_at_once_and_says_how_to_go_on(root):
    out = f"interrupted-{time.monotonic_ns()}"  # of its own, should this test run again
    process = start(root, out)
    deadline = time.monotonic() + 60
    while not has_marks(root / out / "gradebook.db") and time.monotonic() < deadline:
        time.sleep(0.02)
    below = descendants(process.pid)
    os.kill(process.pid, signal.SIGINT)
    _, said = process.communicate(timeout=30)
    assert process.returncode == 130
    assert "run it again" in said
    graded = int(said.split("Stopped: ")[1].split(" of ")[0]) if "Stopped: " in said else 0
    pages = list((root / out / "feedback").glob("*.html"))
    assert len(pages) >= graded
    assert "Traceback" not in said
    assert graded < STUDENTS  # it did not go on to the end
    assert wait_until_gone(below) == []


def test_ctrl_c_while_it_starts_is_no_traceback(root):
    # With `-X importtime` each import is told as it happens.
    program = [sys.executable, "-X", "importtime", "-m", "autograder"]
    process = subprocess.Popen(
        [*program, "--course", "course", "grade", "work", "--out", "at-once"],
        cwd=root,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    assert process.stderr is not None
    for line in process.stderr:
        if "autograder.cli" in line:  # one of those that its own import needs
            break
    os.kill(process.pid, signal.SIGINT)
    _, said = process.communicate(timeout=30)
    assert process.returncode == 130
    assert "Traceback" not in said
    assert "run it again" in said


def test_the_same_submissions_and_seed_give_the_same_marks_though_they_use_chance(
    root, uninterrupted
):
    process = start(root, "again")
    assert process.wait(120) == 0
    assert marks(root / "again/gradebook.db") == uninterrupted
