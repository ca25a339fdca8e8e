"""The coordinator of a cluster needs no more memory after thousands of submissions."""

import gc
import sys
from pathlib import Path

import pytest

pytest.importorskip("distributed", reason="Dask is not installed: uv run --extra cluster pytest")
pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the sandbox is Linux's")

from autograder.grading import dask_cluster  # noqa: E402
from autograder.grading.cluster_messages import pack_result  # noqa: E402
from autograder.grading.dask_address import parse_address  # noqa: E402
from autograder.grading.graded_submission import Graded  # noqa: E402
from autograder.grading.spread import Task  # noqa: E402
from autograder.intake.submissions import Contents, Notebook, Submission  # noqa: E402
from autograder.marking.marker import Marker  # noqa: E402
from tests.classroom import make_course  # noqa: E402

AT_FIRST, BATCH, BATCHES = 300, 700, 3


def task(number: int) -> Task:
    """Some work of 2 KB, different for each student."""
    student = f"student{number:06}"
    cells = [student + "x" * 2000]
    contents = Contents({"3_orchard": Notebook(cells, {}, ())}, {}, {}, [], student)
    return Task(Submission(student, Path(student)), contents)


def test_the_coordinator_remembers_nothing_of_what_was_graded(tmp_path, monkeypatch):
    answer = pack_result(Graded(Submission("", Path()), "graded", "", ()))

    def at_once(data: bytes, plugin: str) -> bytes:
        return answer

    # What a worker does is not what is measured here; it crosses by value.
    monkeypatch.setattr(dask_cluster, "grade_here", at_once)
    marker = Marker(make_course(tmp_path / "course"), 1, tells=False)
    said: list[str] = []
    with dask_cluster.DaskCluster(marker, parse_address("local:1"), tell=said.append) as spread:

        def grade(numbers: range) -> int:
            back = 0
            for number in numbers:
                while not spread.has_room:
                    back += len(spread.finished(wait=True))
                spread.begin(task(number), more=0)
            while spread.under_way:
                back += len(spread.finished(wait=True))
            gc.collect()
            return back

        assert grade(range(AT_FIRST)) == AT_FIRST
        grown = []
        for start in range(AT_FIRST, AT_FIRST + BATCH * BATCHES, BATCH):
            before = sys.getallocatedblocks()
            assert grade(range(start, start + BATCH)) == BATCH
            grown.append(sys.getallocatedblocks() - before)
    assert said == []
    # Of all that is remembered for each, any is at least a block, in every batch. What the process
    # has from other tests (threads that end, caches that fill) grows once.
    assert min(grown) < BATCH, grown
