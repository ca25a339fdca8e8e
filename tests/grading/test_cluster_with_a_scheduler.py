"""A scheduler and workers that somebody else has started: who may grade, who comes, who goes."""

import os
import signal
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from cluster_class import Lab, make_class, marks, start, stored, wait_until

from autograder.cli import main
from autograder.gradebook import Gradebook

pytest.importorskip("distributed", reason="Dask is not installed: uv run --extra cluster pytest")
pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(sys.platform != "linux", reason="the sandbox is Linux's"),
]

STUDENTS = 12
NO_AUTOGRADER = "import sys\nsys.modules['autograder'] = None\n"
NO_BUBBLEWRAP = (
    "import autograder.sandbox.bubblewrap as bubblewrap\n"
    "bubblewrap.find_bubblewrap = lambda: None\n"
)
ANOTHER_NUMPY = (
    "import importlib.metadata as metadata\nversion = metadata.version\n"
    "metadata.version = lambda name: '0.1' if name == 'numpy' else version(name)\n"
)
NO_SANDBOX_LATER = (
    "import autograder.grading.submission as submission\n"
    "from autograder.sandbox.launcher import SandboxError\n"
    "def grade_contents(*arguments):\n    raise SandboxError('The disk is full.')\n"
    "submission.grade_contents = grade_contents\n"
)


@pytest.fixture(scope="module")
def root(tmp_path_factory) -> Path:
    root = tmp_path_factory.mktemp("lab")
    make_class(root, STUDENTS, 2)
    return root


@pytest.fixture(scope="module")
def local(root) -> list[tuple[object, ...]]:
    process = start(root, "threads", "--jobs", "2")
    said, _ = process.communicate(timeout=300)
    assert process.returncode == 0, said
    return marks(root / "threads/gradebook.db")


@pytest.fixture
def lab(root, tmp_path) -> Iterator[Lab]:
    (tmp_path / "course").symlink_to(root / "course")
    lab = Lab(tmp_path, DASK_DISTRIBUTED__SCHEDULER__WORKER_TTL="5s")
    yield lab
    lab.stop()


def test_workers_that_are_not_alike_are_refused_by_name_and_the_others_grade(root, lab, local):
    lab.scheduler()
    lab.worker("good")
    lab.worker("bare", NO_AUTOGRADER)
    lab.worker("weak", NO_BUBBLEWRAP)
    lab.worker("numpy", ANOTHER_NUMPY)
    other = lab.root / "other"
    make_class(other, 0, 0)
    key = other / "course/solutions/answers/orchard.toml"
    key.write_text(key.read_text().replace("credit = 0.25", "credit = 0.75", 1))
    lab.worker("other", AUTOGRADER_COURSE=str(other / "course"))
    lab.wait_for_workers(5)
    process = start(root, "unlike", "--cluster", lab.address)
    said, _ = process.communicate(timeout=300)
    assert process.returncode == 0, said
    refused = [line for line in said.splitlines() if "is refused" in line]
    assert len(refused) == 4
    for worker, reason in {
        "bare": "cannot load this autograder",
        "weak": "its isolation is weaker than the one asked for: it lacks bubblewrap",
        "numpy": "it has numpy 0.1",
        "other": "is another version",
    }.items():
        assert any(f"Worker {worker} " in line and reason in line for line in refused), worker
    assert marks(root / "unlike/gradebook.db") == local
    with (
        Gradebook(root / "unlike/gradebook.db") as book,
        Gradebook(root / "threads/gradebook.db") as threads,
    ):
        assert {record.isolation for record in book.records()} == {
            record.isolation for record in threads.records()
        }


def test_if_every_worker_is_refused_the_run_ends_and_says_why(root, lab):
    lab.scheduler()
    lab.worker("weak", NO_BUBBLEWRAP)
    process = start(root, "refused", "--cluster", lab.address)
    said, _ = process.communicate(timeout=120)
    assert process.returncode == 1
    assert "No worker can be used" in said
    assert "lacks bubblewrap" in said
    assert "Traceback" not in said
    assert stored(root / "refused/gradebook.db") == 0


def test_a_worker_that_breaks_is_left_alone_and_one_that_joins_late_takes_over(root, lab, local):
    lab.scheduler()
    lab.worker("broken", NO_SANDBOX_LATER)
    process = start(root, "late", "--cluster", lab.address)
    said = process.stdout.readline()
    assert "Worker broken" in said
    assert "The disk is full" in said
    lab.worker("late")
    said, _ = process.communicate(timeout=300)
    assert process.returncode == 0, said
    assert marks(root / "late/gradebook.db") == local


@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGSTOP], ids=["dies", "hangs"])
def test_a_scheduler_that_is_lost_ends_the_run_with_one_sentence_and_it_goes_on_later(
    root, lab, local, how
):
    scheduler = lab.scheduler()
    lab.worker("one")
    out = f"lost to {how.name}"
    process = start(root, out, "--cluster", lab.address, **lab.environment)
    wait_until(lambda: stored(root / out / "gradebook.db") >= 3)
    os.kill(scheduler.pid, how)
    said, _ = process.communicate(timeout=60)
    scheduler.kill()
    scheduler.wait()
    assert process.returncode == 1
    assert said.count("\n") == 1, said
    sentence = said
    assert f"The scheduler at {lab.address} has gone. What was graded is kept" in sentence
    assert 3 <= stored(root / out / "gradebook.db") < STUDENTS
    lab.scheduler()
    lab.worker("another")
    process = start(root, out, "--cluster", lab.address)
    said, _ = process.communicate(timeout=300)
    assert process.returncode == 0, said
    assert marks(root / out / "gradebook.db") == local


@pytest.mark.parametrize("how", [signal.SIGSTOP, signal.SIGTERM], ids=["hangs", "leaves"])
def test_a_worker_that_hangs_or_leaves_costs_nobody_a_mark(root, lab, local, how):
    lab.scheduler()
    first = lab.worker("first")
    process = start(root, how.name, "--cluster", lab.address)
    wait_until(lambda: stored(root / how.name / "gradebook.db") >= 2)
    lab.worker("second")
    os.kill(first.pid, how)
    said, _ = process.communicate(timeout=300)
    assert process.returncode == 0, said
    assert marks(root / how.name / "gradebook.db") == local


def test_without_a_scheduler_there_is_one_sentence(root, lab, monkeypatch, capsys):
    monkeypatch.setattr("autograder.grading.dask_connection._CONNECT_SECONDS", 0.5)
    arguments = ["--course", str(root / "course"), "grade", str(root / "work")]
    more = ["--out", str(lab.root / "out"), "--cluster", lab.address]
    assert main([*arguments, *more]) == 1
    (sentence,) = capsys.readouterr().err.splitlines()
    assert f"No Dask scheduler can be reached at {lab.address}" in sentence


def test_without_workers_there_is_one_sentence(root, lab, monkeypatch, capsys):
    monkeypatch.setattr("autograder.grading.dask_crew.FIRST_WORKER_SECONDS", 0.5)
    lab.scheduler()
    arguments = ["--course", str(root / "course"), "grade", str(root / "work")]
    more = ["--out", str(lab.root / "out"), "--cluster", lab.address]
    assert main([*arguments, *more]) == 1
    (sentence,) = capsys.readouterr().err.splitlines()
    assert "The scheduler has no workers; start some with `dask worker ADDRESS`." in sentence
