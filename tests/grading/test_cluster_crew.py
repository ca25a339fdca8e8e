"""Which workers a run waits for when it begins."""

import pytest

pytest.importorskip("distributed", reason="Dask is not installed: uv run --extra cluster pytest")

from autograder.grading import dask_crew
from autograder.grading.dask_address import parse_address
from autograder.grading.dask_cluster import DaskCluster
from autograder.grading.dask_connection import ClusterError
from autograder.grading.dask_crew import Crew, Member
from autograder.marking.marker import Marker
from tests.classroom import make_course

REFUSED = Member("refused", "it has numpy 0.1", host="lab-1")
READY = Member("ready", isolation="bubblewrap", host="lab-2", slots=1)


class Seen(Crew):
    """A crew that sees what it is told: at each look the next of ``looks``, then the last."""

    def __init__(self, looks: list[dict[str, Member]], said: list[str]) -> None:
        super().__init__(None, None, said.append)
        self.looks = looks

    def _see(self) -> None:
        self._members = self.looks.pop(0) if len(self.looks) > 1 else self.looks[0]
        self._names = {address: address.upper() for address in self._members}


@pytest.fixture(autouse=True)
def quick(monkeypatch):
    monkeypatch.setattr(dask_crew, "_NEWCOMER_SECONDS", 0.0)


@pytest.mark.parametrize(
    "looks",
    [
        [{"a": REFUSED}, {"a": REFUSED, "b": READY}],
        [{}, {"a": REFUSED}, {"a": REFUSED}, {}, {"b": Member("preparing")}, {"b": READY}],
        [{"a": Member("new")}, {"a": REFUSED, "b": Member("new")}, {"a": REFUSED, "b": READY}],
    ],
    ids=["one joins", "the refused one leaves", "another prepares longer"],
)
def test_a_worker_that_is_refused_first_does_not_end_a_run_that_others_are_joining(looks):
    said: list[str] = []
    crew = Seen(looks, said)
    crew.wait_for_first()
    assert crew.slots == 1
    assert [sentence.partition(":")[0] for sentence in said] == ["Worker A (a on lab-1) is refused"]
    crew.close()


def test_if_nobody_else_comes_the_run_ends_and_says_why(monkeypatch):
    monkeypatch.setattr(dask_crew, "REFUSED_SECONDS", 0.0)
    crew = Seen([{"a": REFUSED}], [])
    with pytest.raises(ClusterError, match=r"No worker can be used\. A: it has numpy 0\.1\."):
        crew.wait_for_first()
    crew.close()


def test_if_nobody_comes_at_all_it_says_how_to_start_a_worker(monkeypatch):
    monkeypatch.setattr(dask_crew, "FIRST_WORKER_SECONDS", 0.0)
    crew = Seen([{}], [])
    with pytest.raises(ClusterError, match="start some with `dask worker"):
        crew.wait_for_first()
    crew.close()


def test_before_anybody_is_there_the_progress_bar_says_what_is_waited_for(tmp_path):
    marker = Marker(make_course(tmp_path / "course"), 1, tells=False)
    with DaskCluster(marker, parse_address("local:1")) as spread:
        assert spread.describe() == "waiting for workers"
