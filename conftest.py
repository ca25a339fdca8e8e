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


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Try a test once more if it watches real processes or a browser against the clock.

    Their limits are wall time: on a machine that others use too, one may come too late once. A
    real fault fails twice.
    """
    for item in items:
        if {"browser", "sandbox"} & set(item.path.parts):
            item.add_marker(pytest.mark.flaky(reruns=int(os.environ.get("TEST_RERUNS", "1"))))
