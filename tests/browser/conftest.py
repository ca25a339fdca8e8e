"""A window and a JupyterLab for the tests of a file."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from lab import Server
from playwright.sync_api import Browser, BrowserContext, expect

# A machine may be busy with other tests; nothing waits longer than it has to.
PATIENCE = 45_000  # ms
expect.set_options(timeout=PATIENCE)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if "browser" in item.path.parts:
            item.add_marker(pytest.mark.browser)


@pytest.fixture(scope="module")
def window(browser: Browser) -> Iterator[BrowserContext]:
    """One window for the tests of a file: its tabs share what the browser has loaded before."""
    opened = browser.new_context(viewport={"width": 1200, "height": 1000})
    opened.set_default_timeout(PATIENCE)
    yield opened
    opened.close()


@pytest.fixture(scope="module")
def server(browser: Browser, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    """JupyterLab with a copy of the course."""
    started = Server(tmp_path_factory.mktemp("lab"))
    yield started
    started.stop()
