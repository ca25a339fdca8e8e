"""Fixtures that several test modules share: a course to break, the real one, and a browser."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import pytest
from hypothesis import HealthCheck, settings
from playwright.sync_api import Browser, sync_playwright

from autograder import language
from autograder.course import Course, load_course
from tests.toy import Toy, make_toy

# How long an example takes says how busy the machine is, and nothing about the code.
settings.register_profile(
    "any machine", deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("any machine")

os.environ.pop("LANGUAGE", None)  # what is expected is English, wherever the tests run

ROOT = Path(__file__).parent.parent
BROWSERS = ("chromium", "chromium-browser", "google-chrome")
NO_BROWSER = "no browser: install Debian's package chromium, or name one in AUTOGRADER_BROWSER"


def take_solutions_out() -> dict[str, ModuleType]:
    """Forget every imported module of a package ``solutions``, and return them."""
    names = [name for name in sys.modules if name.partition(".")[0] == "solutions"]
    return {name: sys.modules.pop(name) for name in names}


OWN = ("data", "notebooks", "solutions")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Leave out what takes minutes, unless it is asked for."""
    if os.environ.get("AUTOGRADER_LONG") != "1":
        skip = pytest.mark.skip(reason="takes minutes: AUTOGRADER_LONG=1 runs it")
        for item in items:
            if item.get_closest_marker("long"):
                item.add_marker(skip)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    """Give the next test this course's packages and language, whichever course one has loaded."""
    path = sys.path[:]
    before = {n: m for n, m in sys.modules.items() if n.partition(".")[0] in OWN}
    try:
        return (yield)
    finally:
        language.use("")
        sys.path[:] = path
        for name in OWN:
            if name in before and sys.modules.get(name) is not before[name]:
                for loaded in [n for n in sys.modules if n.partition(".")[0] == name]:
                    del sys.modules[loaded]
                own = {n: m for n, m in before.items() if n.partition(".")[0] == name}
                sys.modules.update(own)


@pytest.fixture
def toy(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Toy]:
    """A sound course whose package ``solutions`` stands in for the real one during the test."""
    monkeypatch.delenv("AUTOGRADER_COURSE", raising=False)
    real = take_solutions_out()
    root = tmp_path / "course"
    root.mkdir()
    monkeypatch.syspath_prepend(str(root))
    yield make_toy(root)
    take_solutions_out()
    sys.modules.update(real)


@pytest.fixture(scope="session")
def real_course() -> Course:
    """The course of this repository."""
    return load_course(ROOT)


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """Chromium without a window; without a browser, one clear line.

    For one file only: as long as Playwright runs, its process can have no other event loop.
    """
    program = os.environ.get("AUTOGRADER_BROWSER") or next(
        filter(None, map(shutil.which, BROWSERS)), ""
    )
    if not program:
        if os.environ.get("CI") == "true":
            pytest.fail(NO_BROWSER)
        pytest.skip(NO_BROWSER)
    # Root, as in a container, may not use Chromium's own sandbox; /dev/shm is small there too.
    flags = ["--disable-dev-shm-usage", "--force-color-profile=srgb"]
    if hasattr(os, "geteuid") and os.geteuid() == 0:
        flags.append("--no-sandbox")
    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=program, args=flags)
        yield chromium
        chromium.close()
