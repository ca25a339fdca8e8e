"""What every test run needs, above all that no notebook touches the developer's own responses."""

from __future__ import annotations

import os
from pathlib import Path

import pytest


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
def pytest_xdist_auto_num_workers() -> int:
    """Two workers for each processor: half of the time a test waits for processes or a browser."""
    return 2 * (os.cpu_count() or 1)


# Rooms whose tests start no process, and what in them is an exception: `pytest -m quick`.
_QUICK = {"course", "data", "gradebook", "kinds", "marking", "student"}
_NOT_QUICK = {
    "test_a_kind_from_outside.py",
    "test_broken_gradebooks.py",
    "test_expression_values.py",
    "test_front_ends.py",
    "test_hostile_responses.py",
    "test_marker_process.py",
    "test_unreadable_files.py",
}


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark what is quick; try a test once more that watches real processes or a browser.

    Their limits are wall time: on a machine that others use too, one may come too late once. A
    real fault fails twice.
    """
    for item in items:
        if item.path.parent.name in _QUICK and item.path.name not in _NOT_QUICK:
            item.add_marker(pytest.mark.quick)
        if {"browser", "sandbox"} & set(item.path.parts):
            item.add_marker(pytest.mark.flaky(reruns=int(os.environ.get("TEST_RERUNS", "1"))))
