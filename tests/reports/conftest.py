"""The orchard's course, for the tests of this folder."""

from __future__ import annotations

import pytest

from autograder.course import Course
from tests.classroom import make_course


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Course:
    return make_course(tmp_path_factory.mktemp("orchard") / "course")
