"""What Dask has fetched outlives its worker, and every bad end of a task is seen."""

import os
import signal
import sys
from pathlib import Path

import pytest

pytest.importorskip("distributed", reason="Dask is not installed: uv run --extra cluster pytest")
pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the sandbox is Linux's")

from cluster_class import wait_until, workers  # noqa: E402
from distributed import KilledWorker  # noqa: E402

from autograder.grading import dask_cluster  # noqa: E402
from autograder.grading.cluster_messages import pack_result  # noqa: E402
from autograder.grading.dask_address import parse_address  # noqa: E402
from autograder.grading.dask_cluster import DaskCluster  # noqa: E402
from autograder.grading.dask_connection import ClusterError  # noqa: E402
from autograder.grading.graded_submission import Graded  # noqa: E402
from autograder.grading.spread import Task  # noqa: E402
from autograder.intake.submissions import Contents, Notebook, Submission  # noqa: E402
from autograder.marking.marker import Marker  # noqa: E402
from tests.classroom import make_course  # noqa: E402

ANSWER = pack_result(Graded(Submission("", Path()), "graded", "", (), ("fetched before",)))


def at_once(data: bytes, plugin: str) -> bytes:
    """What a worker does here, instead of grading."""
    return ANSWER


@pytest.fixture(scope="module")
def spread(tmp_path_factory):
    marker = Marker(make_course(tmp_path_factory.mktemp("results") / "course"), 1, tells=False)
    with (
        pytest.MonkeyPatch.context() as patch,
        DaskCluster(marker, parse_address("local:1")) as spread,
    ):
        patch.setattr(dask_cluster, "grade_here", at_once)
        yield spread


def send(spread: DaskCluster, student: str):
    """Send a task, and wait until Dask says what became of it; the spread has not looked yet."""
    contents = Contents({"3_orchard": Notebook([], {}, ())}, {}, {}, [], student)
    spread.begin(Task(Submission(student, Path(student)), contents), more=0)
    # Whatever worker there is now: one that a nanny started again has to prove itself.
    wait_until(lambda: spread._crew.look_after() or spread._completed.has_ready())
    ((_, future),) = spread._sent.values()
    return future


def test_a_result_that_came_before_its_worker_died_counts(spread):
    future = send(spread, "ada")
    assert future.status == "finished"
    for process in workers(os.getpid()):
        os.kill(process, signal.SIGKILL)
    wait_until(lambda: future.status != "finished")
    (graded,) = spread.finished(wait=True)
    assert graded.notes == ("fetched before",)


@pytest.mark.parametrize("is_told", [True, False], ids=["completed", "while it was fetched"])
def test_a_task_that_ended_its_workers_is_seen_however_dask_says_so(spread, is_told):
    future = send(spread, f"bob-{is_told}")
    ((told, _),) = spread._completed.next_batch(block=False)
    error = KilledWorker(future.key, None, 2)
    future._state.set_error(error, None)
    if is_told:
        spread._completed.queue.put((told, (KilledWorker, error, None)))
    (graded,) = spread.finished(wait=True)  # alone, at the second attempt
    assert graded.notes == ("fetched before",)
    assert spread.under_way == 0


def test_what_is_cancelled_while_it_is_fetched_is_said_not_waited_for(spread):
    future = send(spread, "cy")
    spread._completed.clear()
    future._state.cancel("scheduler-connection-lost")
    with pytest.raises(ClusterError, match="The scheduler at local:1 has gone"):
        spread.finished(wait=True)
    assert spread.under_way == 0
