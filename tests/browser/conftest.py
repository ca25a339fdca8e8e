"""A browser and a JupyterLab for the tests of a file. Without a browser: one clear line."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator

import pytest
from lab import Server
from playwright.sync_api import Browser, BrowserContext, expect, sync_playwright

NAMES = ("chromium", "chromium-browser", "google-chrome")
# A machine may be busy with other tests; nothing waits longer than it has to.
PATIENCE = 45_000  # ms
MISSING = "no browser: install Debian's package chromium, or name one in AUTOGRADER_BROWSER"


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if "browser" in item.path.parts:
            item.add_marker(pytest.mark.browser)


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """Chromium without a window."""
    program = os.environ.get("AUTOGRADER_BROWSER") or next(
        filter(None, map(shutil.which, NAMES)), ""
    )
    if not program:
        if os.environ.get("CI") == "true":
            pytest.fail(MISSING)
        pytest.skip(MISSING)
    # Root, as in a container, may not use Chromium's own sandbox; /dev/shm is small there too.
    flags = ["--disable-dev-shm-usage", "--force-color-profile=srgb"]
    if hasattr(os, "geteuid") and os.geteuid() == 0:
        flags.append("--no-sandbox")
    expect.set_options(timeout=PATIENCE)
    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=program, args=flags)
        yield chromium
        chromium.close()


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
