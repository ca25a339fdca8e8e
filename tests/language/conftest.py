"""Every test of the room begins and ends in English."""

from collections.abc import Iterator

import pytest

from autograder import language


@pytest.fixture(autouse=True)
def _english_again(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.delenv("LANGUAGE", raising=False)
    language.follow_environment()
    yield
    language.use("")
    monkeypatch.delenv("LANGUAGE", raising=False)
    language.follow_environment()
