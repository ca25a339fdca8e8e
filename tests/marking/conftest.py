"""A course with variants, for the tests of this folder."""

from __future__ import annotations

from pathlib import Path

import pytest
from market import make_market
from tiny_course import TinyCourse


@pytest.fixture
def market(tmp_path: Path) -> TinyCourse:
    return make_market(tmp_path / "course")
