"""Fixtures that several test modules share: a small course to break, and the real one."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import pytest
from tiny_course import TinyCourse, make_tiny_course

from autograder.course import Course, load_course

ROOT = Path(__file__).parent.parent


def take_solutions_out() -> dict[str, ModuleType]:
    """Forget every imported module of a package ``solutions``, and return them."""
    names = [name for name in sys.modules if name.partition(".")[0] == "solutions"]
    return {name: sys.modules.pop(name) for name in names}


@pytest.fixture
def tiny_course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[TinyCourse]:
    """A sound course whose package ``solutions`` stands in for the real one during the test."""
    monkeypatch.delenv("AUTOGRADER_COURSE", raising=False)
    real = take_solutions_out()
    root = tmp_path / "course"
    root.mkdir()
    monkeypatch.syspath_prepend(str(root))
    yield make_tiny_course(root)
    take_solutions_out()
    sys.modules.update(real)


@pytest.fixture(scope="session")
def real_course() -> Course:
    """The course of this repository."""
    return load_course(ROOT)
