"""The file beside the notebooks that holds what was answered."""

from __future__ import annotations

import json
import multiprocessing
import os
from pathlib import Path

import pytest
from filelock import FileLock

from autograder import ask, check, progress
from autograder.exchange.identity import FILE
from autograder.student import responses as module
from autograder.student.responses import Responses, ResponsesError, responses_folder


def test_a_response_is_kept_with_attempts_and_mark(orchard: Path):
    ask("Q1").respond([True, True])
    ask("Q1").respond([False, True])
    entry = json.loads((orchard / "orchard.json").read_text())["responses"]["Q1"]
    assert entry["response"] == [False, True]
    assert entry["attempts"] == 2
    assert (entry["status"], entry["points"]) == ("right", 2)
    assert entry["answered_at"].endswith("+00:00")


def test_a_value_is_kept_as_it_was_understood_and_never_as_code(orchard: Path):
    check("Q2", 12)
    entry = Responses(orchard, "orchard").get("Q2")
    assert entry["understood"] == "12"
    assert entry["response"] is None


def test_other_answers_survive_a_new_one(tmp_path: Path):
    kept = Responses(tmp_path, "orchard")
    kept.record("Q1", {"response": [True]})
    Responses(tmp_path, "orchard").record("Q5", {"response": ["sow"]})
    assert {id: entry["response"] for id, entry in kept.all().items()} == {
        "Q1": [True],
        "Q5": ["sow"],
    }


@pytest.mark.parametrize(
    "damage",
    [
        b"",
        b"{",
        b"\xff\xfe\x00",
        b"[]",
        b'{"responses": [1]}',
        b'{"responses": {"Q1": 3}}',
        b"[" * 100_000,
    ],
)
def test_a_damaged_file_is_kept_aside_and_said_so(
    orchard: Path, capsys: pytest.CaptureFixture[str], damage: bytes
):
    orchard.mkdir()
    (orchard / "orchard.json").write_bytes(damage)
    assert "Q1" in repr(ask("Q1"))
    ask("Q1").respond([False, True])
    aside = list(orchard.glob("orchard.damaged-*.json"))
    assert [path.read_bytes() for path in aside] == [damage]
    assert aside[0].name in capsys.readouterr().out
    assert Responses(orchard, "orchard").get("Q1")["response"] == [False, True]


def test_a_write_that_fails_half_way_leaves_the_old_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    kept = Responses(tmp_path, "orchard")
    kept.record("Q1", {"response": [True]})
    before = kept.path.read_bytes()

    def full_disk(descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full_disk)
    with pytest.raises(ResponsesError, match=r"NOT saved.*No space left"):
        kept.record("Q1", {"response": [False]})
    assert kept.path.read_bytes() == before
    assert list(tmp_path.glob("*.tmp")) == []


def test_an_answer_that_cannot_be_saved_says_so_and_shows_no_mark(
    orchard: Path, capsys: pytest.CaptureFixture[str]
):
    orchard.write_text("a file stands where the folder should be", encoding="utf-8")
    assert ask("Q1").respond([False, True]) is None
    said = capsys.readouterr().out
    assert said.count("\n") == 1
    assert "NOT saved" in said


def test_a_file_that_somebody_else_holds_is_waited_for_and_then_given_up(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr(module, "LOCK_SECONDS", 0.1)
    with FileLock(tmp_path / "orchard.lock"), pytest.raises(ResponsesError, match="NOT saved"):
        Responses(tmp_path, "orchard").record("Q1", {"response": [True]})


def _answer_often(folder: Path, id: str) -> None:
    for _ in range(20):
        Responses(folder, "orchard").record(id, {"response": [True]})


def test_two_kernels_that_write_at_once_lose_nothing(tmp_path: Path):
    start = multiprocessing.get_context("spawn")
    writers = [start.Process(target=_answer_often, args=(tmp_path, id)) for id in ("Q1", "Q5")]
    for writer in writers:
        writer.start()
    for writer in writers:
        writer.join()
    entries = Responses(tmp_path, "orchard").all()
    assert {id: entry["attempts"] for id, entry in entries.items()} == {"Q1": 20, "Q5": 20}


def test_responses_stand_beside_the_notebook_that_runs(own_orchard: Path):
    assert responses_folder(own_orchard) == own_orchard / "notebooks/responses"
    ask("Q1").respond([False, True])
    assert (own_orchard / "notebooks/responses/orchard.json").exists()


def test_outside_a_folder_of_notebooks_responses_stand_beside_the_courses_own(
    own_orchard: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.chdir(own_orchard)
    assert responses_folder(own_orchard) == own_orchard / "notebooks/responses"


def test_progress_counts_answered_questions_and_points(orchard: Path):
    assert "0 of 5" in repr(progress())
    assert "0 of 13" in repr(progress())
    ask("Q1").respond([True, True])
    check("Q2", 12)
    assert "2 of 5" in repr(progress())
    assert "3 of 13" in repr(progress())


def test_a_file_that_another_kernel_has_mended_is_not_set_aside_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    slow, fast = Responses(tmp_path, "orchard"), Responses(tmp_path, "orchard")
    slow.path.write_text("{")

    def meanwhile() -> dict:
        fast.mend()
        fast.record("Q1", {"response": [True, None]})
        return {}

    monkeypatch.setattr(slow, "_rescue", meanwhile)
    assert slow.mend() == ""
    assert slow.get("Q1")["response"] == [True, None]
    assert [path.read_text() for path in tmp_path.glob("*.damaged-*")] == ["{"]


def test_a_file_that_cannot_be_read_for_a_moment_is_no_damaged_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    responses = Responses(tmp_path, "orchard")
    responses.record("Q1", {"response": [True, None]})
    with monkeypatch.context() as patch:
        patch.setattr(Path, "read_text", lambda *_, **__: (_ for _ in ()).throw(PermissionError()))
        with pytest.raises(ResponsesError, match="NOT saved"):
            responses.record("Q5", {"response": 1})
        with pytest.raises(ResponsesError, match="NOT saved"):
            responses.mend()
    assert responses.get("Q1")["response"] == [True, None]
    assert list(tmp_path.glob("*.damaged-*")) == []


def test_a_name_that_cannot_be_kept_is_called_a_name(tmp_path: Path):
    (tmp_path / "responses").write_text("a file in the folder's place")
    with pytest.raises(ResponsesError, match=r"^Your name was NOT saved"):
        Responses(tmp_path / "responses", FILE).update(FILE, lambda entry: {"response": "Ada"})
