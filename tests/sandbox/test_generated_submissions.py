"""Hostile submissions made by chance; whatever they do, these things hold.

The batch ends, siblings keep their marks, nothing secret comes out, the trusted process stays
within its budget, no file outside changes, and no process is left.

`AUTOGRADER_HOSTILE=10000 pytest -m hostile tests/sandbox/test_generated_submissions.py` runs many.
"""

import os
import time
from pathlib import Path

import pytest
from attacks import CASE, LIMITS, NUMBER, SECRET, check_good, tree
from hostile import submission
from msgspec.structs import replace

from autograder.sandbox.launcher import Sandbox, Stopped
from autograder.sandbox.processes import tasks_of
from autograder.sandbox.session import Session

MANY = int(os.environ.get("AUTOGRADER_HOSTILE", "0"))
FROM = int(os.environ.get("AUTOGRADER_HOSTILE_FROM", "0"))
TINY = replace(LIMITS, notebook_seconds=1, cell_seconds=0.3, question_seconds=0.3, memory_mb=200)
BUDGET = 2**20  # kB over its start


def resident() -> int:
    lines = Path("/proc/self/status").read_text(encoding="utf-8").splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith("VmHWM"))


def put(sandbox: Sandbox, seed: int, canary: Path) -> str:
    """What comes out of one submission, as text."""
    cells, names = submission(seed)
    cells[0] += f"\nCANARY, GRADER = {str(canary)!r}, {os.getpid()}"
    probes = [{**CASE, "cases": [{"args": [1.0]}]}, NUMBER]
    found = []
    with Session(sandbox._take_host, TINY, 1, time.monotonic() + 30) as session:
        try:
            found.append(session.run(cells, names))
        except Stopped as stopped:
            found.append(stopped.why)
        for name, probe in zip(names, probes, strict=True):
            try:
                found.append(session.evaluate(name, probe))
            except Stopped as stopped:
                found.append(stopped.why)
    return repr(found)


def run_many(sandbox: Sandbox, course, folder: Path, seeds: range) -> None:
    canary = folder / "canary"
    canary.write_text(SECRET)
    folder.chmod(0o755)
    canary.chmod(0o666)
    before, state, started = tree(course.root), canary.stat(), resident()
    for done, seed in enumerate(seeds, 1):
        out = put(sandbox, seed, canary)
        assert SECRET not in out, seed
        assert resident() - started < BUDGET, seed
        after = canary.stat()
        assert canary.read_text() == SECRET, seed
        assert (after.st_mode, after.st_mtime_ns, after.st_uid, after.st_nlink) == (
            (state.st_mode, state.st_mtime_ns, state.st_uid, state.st_nlink)
        ), seed
        if done % 25 == 0:
            check_good(sandbox)
            print(seed, flush=True)
    check_good(sandbox)
    assert tree(course.root) == before
    host = sandbox._take_host()
    if host._identity:  # as root each sandbox has a user of its own: the zygote alone is left
        assert tasks_of(host._identity) <= 2


def test_a_few_hostile_submissions_break_nothing(sandbox, course, tmp_path):
    run_many(sandbox, course, tmp_path, range(30))


@pytest.mark.hostile
@pytest.mark.skipif(MANY == 0, reason="a long run, asked for by AUTOGRADER_HOSTILE=10000")
def test_many_hostile_submissions_break_nothing(sandbox, course, tmp_path):
    run_many(sandbox, course, tmp_path, range(FROM, FROM + MANY))
