"""Nothing stays in the system's temporary folder for good, however a run ends."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from autograder.sandbox import own_folder
from autograder.sandbox.own_folder import OwnFolder

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="locks of this kind are POSIX's")
HOLD = """
from autograder.sandbox.own_folder import OwnFolder
print(OwnFolder().path, flush=True)
input()
"""


@pytest.fixture(autouse=True)
def temporary(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr(tempfile, "tempdir", None)
    monkeypatch.setattr(own_folder, "_SETTLED", -1.0)
    return tmp_path


def held() -> tuple[subprocess.Popen[str], Path]:
    """Another process that holds a folder."""
    process = subprocess.Popen(
        [sys.executable, "-c", HOLD], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    assert process.stdout is not None
    folder = Path(process.stdout.readline().strip())
    assert folder.is_dir()
    return process, folder


def make_deep(folder: Path) -> None:
    inner = os.open(folder, os.O_RDONLY)
    for _ in range(3000):
        os.mkdir("d", dir_fd=inner)
        outer, inner = inner, os.open("d", os.O_RDONLY, dir_fd=inner)
        os.close(outer)
    os.close(inner)


def end(process: subprocess.Popen[str]) -> None:
    process.kill()
    process.communicate()


def test_a_folder_is_removed_with_all_that_is_in_it():
    with OwnFolder() as folder:
        (folder / "file").write_text("x")
    assert not folder.exists()


def test_folders_too_deep_for_recursion_are_removed():
    with OwnFolder() as folder:
        make_deep(folder)
    assert not folder.exists()


def test_a_deep_folder_that_a_killed_process_left_is_removed_by_the_next_one():
    process, folder = held()
    make_deep(folder)
    end(process)
    with OwnFolder():
        assert not folder.exists()


def test_what_links_lead_to_is_kept(temporary: Path):
    kept = temporary / "kept"
    kept.mkdir()
    (kept / "file").write_text("x")
    kept.chmod(0o555)
    with OwnFolder() as folder:
        (folder / "link").symlink_to(kept)
        (folder / "inner").mkdir()
        (folder / "inner" / "link").symlink_to(kept)
    assert (kept / "file").read_text() == "x"
    assert kept.stat().st_mode & 0o777 == 0o555


def test_closed_folders_are_removed():
    with OwnFolder() as folder:
        (folder / "a" / "b" / "c").mkdir(parents=True)
        (folder / "a" / "b").chmod(0)
        (folder / "a").chmod(0)
    assert not folder.exists()


def test_what_a_killed_process_left_is_removed_by_the_next_one():
    process, folder = held()
    end(process)
    with OwnFolder():
        assert not folder.exists()


def test_the_folder_of_a_process_that_lives_stays():
    process, folder = held()
    with OwnFolder():
        assert folder.is_dir()
    end(process)


def test_a_folder_that_is_just_being_made_stays(monkeypatch):
    monkeypatch.setattr(own_folder, "_SETTLED", 60.0)
    process, folder = held()
    end(process)
    with OwnFolder():
        assert folder.is_dir()


def test_what_others_named_alike_stays(temporary: Path):
    mine = temporary / "autograder-thesis"
    mine.mkdir()
    target = temporary / "elsewhere"
    target.mkdir()
    (target / own_folder._LOCK).touch()
    (temporary / "autograder-link").symlink_to(target)
    trap = temporary / "autograder-trap"
    trap.mkdir()
    os.symlink(mine / "precious", trap / own_folder._LOCK)
    with OwnFolder():
        assert mine.is_dir()
        assert target.is_dir()
        assert trap.is_dir()
