"""A course with variants, for the tests of this folder."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.toy import Toy
from tests.toy.market import make_market


@pytest.fixture
def market(tmp_path: Path) -> Toy:
    return make_market(tmp_path / "course")
