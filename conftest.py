"""What every test run needs, above all that no notebook touches the developer's own responses."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import hypothesis
import pytest

# Hundreds of processes are started here, and this variable, which many containers set, would make
# each of them compile anew what it imports.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False
# Threads of NumPy's libraries would fight the other workers for the processors: a notebook that
# takes five seconds took a minute. All processes that are started here inherit this.
for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(name, "1")


@pytest.fixture(scope="session", autouse=True)
def _no_responses_of_the_developer(tmp_path_factory: pytest.TempPathFactory) -> None:
    os.environ["AUTOGRADER_RESPONSES"] = str(tmp_path_factory.mktemp("responses"))
    os.environ["AUTOGRADER_WIDGETS"] = "0"  # plain outputs, even in a terminal of JupyterLab


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup(item: pytest.Item) -> None:
    """Give each notebook that nbval runs a folder of its own for its responses.

    A kernel takes over the environment when it starts, and nbval starts it after this hook.
    """
    if type(item).__name__ == "IPyNbCell":
        base = Path(item.config._tmp_path_factory.getbasetemp())  # type: ignore[attr-defined]
        folder = base / "notebooks" / item.path.parent.name / item.path.stem
        folder.mkdir(parents=True, exist_ok=True)
        os.environ["AUTOGRADER_RESPONSES"] = str(folder)
        os.environ["AUTOGRADER_WIDGETS"] = "0"  # no fixture is set up where only notebooks run


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_auto_num_workers(config: pytest.Config) -> int:
    """Two workers for each processor: half of the time a test waits for processes or a browser.

    What is quick waits for nothing.
    """
    return (1 if config.option.markexpr == "quick" else 2) * (os.cpu_count() or 1)


_HERE = Path(__file__).parent
# Rooms whose tests start no process, and what in them is an exception: `pytest -m quick`.
_QUICK = {"course", "data", "gradebook", "kinds", "marking", "student"}
_NOT_QUICK = {
    "test_a_kind_from_outside.py",
    "test_check.py",
    "test_course_path.py",
    "test_broken_gradebooks.py",
    "test_expression_values.py",
    "test_front_ends.py",
    "test_hostile_responses.py",
    "test_identity.py",
    "test_marker_process.py",
    "test_practice.py",
    "test_rescue.py",
    "test_responses.py",
    "test_submission.py",
    "test_true_false_and_order.py",
    "test_unreadable_files.py",
    "test_what_is_left.py",
    "test_widgets_without_a_browser.py",
}
# Files that take longest. They begin first: begun last, one alone would keep the whole run waiting.
_LONG = (
    "tests/browser/test_widgets.py",
    "tests/grading/test_cluster.py",
    "tests/test_the_course.py",
    "tests/browser/test_journey.py",
    "tests/authoring/test_new.py",
    "tests/sandbox/test_hostile_classes.py",
    "tests/sandbox/test_own_time.py",
    "tests/sandbox/test_sessions.py",
    "tests/sandbox/test_machine_allows.py",
    "tests/sandbox/test_attacks_hanging_and_dying.py",
    "solutions/notebooks/1_place_recognition.ipynb",
    "tests/browser/test_second_course.py",
    "tests/grading/test_cluster_memory.py",
    "notebooks/1_place_recognition.ipynb",
)


def pytest_configure(config: pytest.Config) -> None:
    """Where only quick tests are asked for, look at fewer examples of what is drawn."""
    if config.option.markexpr == "quick":
        hypothesis.settings.register_profile("quick", max_examples=15)
        hypothesis.settings.load_profile("quick")


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Where only quick tests are asked for, the others need not even be read."""
    if config.option.markexpr != "quick" or not collection_path.is_relative_to(_HERE):
        return None
    room = collection_path.relative_to(_HERE).parts[:2]
    in_tests = room[:1] in ((), ("tests",)) and (len(room) < 2 or room[1] in _QUICK)
    return None if in_tests and collection_path.name not in _NOT_QUICK else True


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Begin with what takes long; mark what is quick; try a test once more that watches real
    processes, a cluster's workers or a browser.

    Their limits are wall time: on a machine that others use too, one may come too late once. A
    real fault fails twice.
    """
    order = {_HERE / file: place for place, file in enumerate(_LONG)}
    items.sort(key=lambda item: order.get(item.path, len(order)))
    for item in items:
        if item.path.parent.name in _QUICK and item.path.name not in _NOT_QUICK:
            item.add_marker(pytest.mark.quick)
        if {"browser", "sandbox"} & set(item.path.parts) or "cluster" in item.path.name:
            item.add_marker(pytest.mark.flaky(reruns=int(os.environ.get("TEST_RERUNS", "1"))))
