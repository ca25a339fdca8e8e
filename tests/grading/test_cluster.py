"""A class on a Dask cluster: the same marks as here, whoever dies on the way."""

import os
import signal
import sys
from pathlib import Path

import pytest
from cluster_class import (
    kill_workers_at_random,
    make_class,
    marks,
    start,
    stored,
    wait_until,
    workers,
)

from autograder.sandbox.processes import descendants
from tests.classroom import hand_in

pytest.importorskip("distributed", reason="Dask is not installed: uv run --extra cluster pytest")
pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the sandbox is Linux's")

# AUTOGRADER_CLUSTER=300 grades a whole class and kills a worker at ten random moments.
STUDENTS = int(os.environ.get("AUTOGRADER_CLUSTER", "12"))
HOSTILE, KILLS = (10, 10) if STUDENTS >= 100 else (4, 1)


@pytest.fixture(scope="module")
def root(tmp_path_factory) -> Path:
    root = tmp_path_factory.mktemp("cluster")
    make_class(root, STUDENTS, HOSTILE)
    return root


@pytest.fixture(scope="module")
def local(root) -> list[tuple[object, ...]]:
    process = start(root, "threads", "--jobs", "2")
    said, _ = process.communicate(timeout=300)
    assert process.returncode == 0, said
    return marks(root / "threads/gradebook.db")


def is_running(process: int) -> bool:
    try:
        return Path(f"/proc/{process}/stat").read_bytes().rpartition(b")")[2].split()[0] != b"Z"
    except OSError:
        return False


def test_workers_that_are_killed_change_no_mark(root, local):
    process = start(root, "killed", "--cluster", "local:2")
    killed = kill_workers_at_random(process, root / "killed/gradebook.db", STUDENTS, KILLS, 3)
    said, _ = process.communicate(timeout=max(300, 10 * STUDENTS))
    assert process.returncode == 0, said
    assert killed == KILLS
    assert "Traceback" not in said
    assert len(local) == 4 * STUDENTS
    assert marks(root / "killed/gradebook.db") == local


@pytest.mark.long
def test_a_killed_coordinator_leaves_no_process_and_goes_on_where_it_was(root, local):
    gradebook = root / "gone/gradebook.db"
    process = start(root, "gone", "--cluster", "local:2")
    wait_until(lambda: stored(gradebook) >= 3)
    below = descendants(process.pid)
    process.kill()
    process.communicate()
    wait_until(lambda: not any(map(is_running, below)), 30)
    before = stored(gradebook)
    assert 3 <= before < STUDENTS
    process = start(root, "gone", "--cluster", "local:2")
    said, _ = process.communicate(timeout=300)
    assert process.returncode == 0, said
    assert marks(gradebook) == local


@pytest.mark.parametrize("whole_group", [False, True], ids=["coordinator", "whole terminal"])
def test_ctrl_c_stops_soon_and_keeps_what_was_graded(root, local, whole_group):
    name = f"interrupted-{whole_group}"
    process = start(root, name, "--cluster", "local:2")
    wait_until(lambda: stored(root / name / "gradebook.db") >= 3)
    below = descendants(process.pid)
    (os.killpg if whole_group else os.kill)(process.pid, signal.SIGINT)
    said, _ = process.communicate(timeout=60)
    assert process.returncode in (1, 130)
    assert "were graded; their reports are written; run it again to go on." in said
    assert "Traceback" not in said
    wait_until(lambda: not any(map(is_running, below)), 30)
    kept = marks(root / name / "gradebook.db")
    assert kept
    assert set(kept) <= set(local)


DEADLY = """

def compare(case, expected, actual):
    if actual == 666.0:
        import os
        with open(os.environ["DEATHS"], "a") as file:
            file.write("x")
        os.kill(os.getpid(), 9)
    return expected == actual
"""


@pytest.mark.long
def test_a_submission_that_kills_its_workers_is_marked_so_and_the_rest_goes_on(tmp_path):
    """Its marks say that this is the grader's fault; whoever shared a worker loses nothing."""
    make_class(tmp_path, 6, 0)
    reference = tmp_path / "course/orchard_reference.py"
    reference.write_text(reference.read_text() + DEADLY)
    key = tmp_path / "course/solutions/answers/orchard.toml"
    cases = 'cases = "orchard_reference:heaviest_cases"\n'
    key.write_text(
        key.read_text().replace(cases, f'{cases}compare = "orchard_reference:compare"\n')
    )
    local = start(tmp_path, "threads")
    assert local.communicate(timeout=120)
    hand_in(tmp_path / "work", "deadly", Q4="def heaviest(w):\n    return 666.0")
    deaths = tmp_path / "deaths"
    process = start(tmp_path, "out", "--cluster", "local:2", DEATHS=str(deaths))
    said, _ = process.communicate(timeout=300)
    assert process.returncode == 0, said
    found = marks(tmp_path / "out/gradebook.db")
    of_deadly = [mark for student, _, mark in found if student == "deadly"]
    assert len(of_deadly) == 4
    assert all('"killed"' in mark and "say nothing about the work" in mark for mark in of_deadly)
    assert [row for row in found if row[0] != "deadly"] == marks(tmp_path / "threads/gradebook.db")
    # Three times in company, three times alone.
    assert len(deaths.read_text()) == 6
    # And it is not run again.
    process = start(tmp_path, "out", "--cluster", "local:2", DEATHS=str(deaths))
    assert process.communicate(timeout=120)
    assert len(deaths.read_text()) == 6
    assert not workers(process.pid)
