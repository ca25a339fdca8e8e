"""A class on a Dask cluster: the same marks as here, whoever dies on the way."""

from pathlib import Path

import pytest
from cluster_class import kill_workers_at_random, make_class, marks, start

pytest.importorskip("distributed", reason="Dask is not installed: uv run --extra cluster pytest")

STUDENTS, HOSTILE, KILLS = 30, 10, 4


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


def test_workers_that_are_killed_change_no_mark(root, local):
    process = start(root, "killed", "--cluster", "local:2")
    killed = kill_workers_at_random(process, root / "killed/gradebook.db", STUDENTS, KILLS, 3)
    said, _ = process.communicate(timeout=300)
    assert process.returncode == 0, said
    assert killed == KILLS
    assert "Traceback" not in said
    assert len(local) == 4 * STUDENTS
    assert marks(root / "killed/gradebook.db") == local
