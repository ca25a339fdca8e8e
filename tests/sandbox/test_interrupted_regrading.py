"""A run that is killed while it grades anew or writes reports: going on mends everything."""

import csv
import random
import re
import shutil
import sqlite3
import subprocess
import sys
import time
from contextlib import closing
from pathlib import Path

import pytest

from tests.classroom import hand_in, make_course

pytestmark = pytest.mark.long

STUDENTS = [f"student{number}" for number in range(6)]
Marks = dict[str, list[tuple[object, ...]]]


@pytest.fixture(scope="module")
def root(tmp_path_factory) -> Path:
    """A graded class, of which the key has then changed."""
    root = tmp_path_factory.mktemp("regraded")
    make_course(root / "course")
    for student in STUDENTS:
        hand_in(root / "work", student, Q2="import time\ntime.sleep(0.15)\ntrees = 7")
    assert start(root, "old", "grade", "work").wait(120) == 0
    key = root / "course/solutions/answers/orchard.toml"
    key.write_text(key.read_text().replace("credit = 0.25", "credit = 0.75", 1))
    return root


def start(root: Path, out: str, *command: str) -> subprocess.Popen[bytes]:
    program = [sys.executable, "-m", "autograder", "--course", "course", *command]
    return subprocess.Popen(
        [*program, "--out", out, "--seed", "7", "--jobs", "2"],
        cwd=root,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )


def kill(process: subprocess.Popen[bytes]) -> None:
    process.kill()  # nothing happens if it was faster
    process.wait()


def marks(out: Path) -> Marks:
    """Every student's marks, without when and how fast they were given."""
    with closing(sqlite3.connect(out / "gradebook.db")) as db:
        rows = db.execute("SELECT student, question, mark FROM mark ORDER BY student, question")
        found: Marks = {}
        for student, *rest in rows:
            found.setdefault(student, []).append(tuple(rest))
        return found


def copy_of(root: Path, name: str) -> Path:
    shutil.rmtree(root / name, ignore_errors=True)  # of a test that is tried once more
    shutil.copytree(root / "old", root / name)
    return root / name


def reports(out: Path) -> dict[str, object]:
    """Every report with what tells a whole one: an end, or all the rows."""
    return {
        path.name: bool(re.search(r"</html>\s*(<!--[^>]*-->\s*)?$", path.read_text()))
        if path.suffix == ".html"
        else len(list(csv.reader(path.read_text().splitlines())))
        for path in out.rglob("*")
        if path.suffix in (".html", ".csv")
    }


@pytest.fixture(scope="module")
def regraded(root) -> Marks:
    out = copy_of(root, "whole")
    before = marks(out)
    assert start(root, "whole", "regrade").wait(120) == 0
    after = marks(out)
    assert all(before[student] != after[student] for student in STUDENTS)
    return after


def test_a_regrading_killed_at_random_moments_ends_with_the_same_marks(root, regraded):
    old = marks(root / "old")
    out = copy_of(root, "killed")
    rng = random.Random(3)
    for _ in range(3):
        process = start(root, "killed", "regrade")
        time.sleep(rng.uniform(0.8, 2.5))
        kill(process)
        now = marks(out)
        assert now.keys() == old.keys()
        # Nobody's marks are partly of the one key and partly of the other.
        assert all(now[student] in (old[student], regraded[student]) for student in STUDENTS)
    assert start(root, "killed", "regrade").wait(120) == 0
    assert marks(out) == regraded


def test_a_run_killed_while_it_writes_reports_leaves_whole_ones_and_the_next_writes_all(
    root, regraded
):
    out = copy_of(root, "reports")
    assert start(root, "reports", "regrade").wait(120) == 0
    expected = reports(out)
    assert expected["student5.html"] is True
    assert expected["grades.csv"] == 1 + len(STUDENTS)
    rng = random.Random(5)
    for _ in range(4):
        shutil.rmtree(out / "feedback")
        process = start(root, "reports", "grade", "work")
        while process.poll() is None and not (out / "feedback").exists():
            pass  # not even a short sleep: writing takes a few milliseconds
        time.sleep(rng.uniform(0, 0.004))
        kill(process)
        found = reports(out)
        assert {"grades.csv", "class.html"} <= found.keys()
        assert found.items() <= expected.items()
        assert marks(out) == regraded
    assert start(root, "reports", "grade", "work").wait(120) == 0
    assert reports(out) == expected
    assert not list(out.rglob("*.tmp"))
    assert marks(out) == regraded
