"""A drop folder: two students as users of their own, an instructor, and what `collect` makes of it.

The students are numeric ids without accounts, which a process of root may take on.
"""

from __future__ import annotations

import csv
import hashlib
import os
import shutil
import tempfile
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from autograder.cli import main
from autograder.errors import AutograderError, UsageError
from autograder.intake import drop_folder
from autograder.intake.drop_folder import collect, name_in_files
from autograder.student.put_into_drop_folder import drop, user_name

ADA, BOB, STUDENTS, STAFF = 64001, 64002, 64100, 64200
MB = 2**20
as_root = pytest.mark.skipif(
    not hasattr(os, "geteuid") or os.geteuid() != 0,
    reason="only root can act as two students",
)


def as_user(user: int, action: Callable[[], object]) -> str:
    """What an action says as a user of the students' group only, or which error it meets."""
    here, there = os.pipe()
    process = os.fork()
    if process == 0:
        try:
            os.setgroups([])
            os.setgid(STUDENTS)
            os.setuid(user)
            said = str(action())
        except (OSError, AutograderError) as error:
            said = f"{type(error).__name__}: {error}"
        finally:
            os.write(there, said.encode())
            os._exit(0)
    os.close(there)
    with open(here, "rb") as pipe:
        said = pipe.read().decode()
    os.waitpid(process, 0)
    return said


@pytest.fixture
def open_to_all() -> Iterator[Path]:
    """A folder that every user reaches, with the drop folder of an instructor in it."""
    # Not pytest's own folder: each run that starts beside this one closes the root of all of them.
    with tempfile.TemporaryDirectory(prefix="drop-") as made:
        folder = Path(made)
        folder.chmod(0o755)
        taking = folder / "drop"
        taking.mkdir()
        os.chown(taking, 0, STAFF)
        taking.chmod(0o3773)
        yield folder


def packed(folder: Path, name: str, content: str) -> Path:
    path = folder / name
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("1_garden.ipynb", content)
    path.chmod(0o644)
    return path


def hand_in(user: int, path: Path, folder: Path) -> str:
    return as_user(user, lambda: drop(path, folder))


@as_root
def test_no_student_reads_lists_or_deletes_what_another_handed_in(open_to_all: Path):
    work = packed(open_to_all, "work.zip", "mine")
    taking = open_to_all / "drop"
    kept = Path(hand_in(ADA, work, taking))
    assert kept.name.startswith(f"user-{ADA}_")
    found = kept.stat()
    assert (found.st_uid, found.st_gid, oct(found.st_mode & 0o777)) == (ADA, STAFF, "0o640")
    attempts: dict[str, Callable[[], object]] = {
        "read": kept.read_bytes,
        "list": lambda: os.listdir(taking),
        "delete": kept.unlink,
        "rename": lambda: kept.rename(taking / "mine.zip"),
        "write": lambda: kept.write_bytes(b""),
    }
    for what, attempt in attempts.items():
        assert as_user(BOB, attempt).startswith("PermissionError"), what
    assert kept.read_bytes() == work.read_bytes()


@as_root
@pytest.mark.parametrize(
    ("mode", "group", "said"),
    [
        (0o1777, STAFF, "set-group-id bit is missing"),
        (0o3777, STUDENTS, "a group without students"),
        (0o2773, STAFF, "sticky bit is missing"),
        (0o3750, STAFF, "did not take your work"),
    ],
)
def test_a_folder_that_protects_nobody_gets_nothing(
    open_to_all: Path, mode: int, group: int, said: str
):
    taking = open_to_all / "drop"
    os.chown(taking, 0, group)
    taking.chmod(mode)
    answer = hand_in(ADA, packed(open_to_all, "work.zip", "mine"), taking)
    assert said in answer
    assert "nothing was handed in" in answer
    assert list(taking.iterdir()) == []


@as_root
def test_the_newest_of_each_is_taken_with_its_time(
    open_to_all: Path, capsys: pytest.CaptureFixture[str]
):
    taking, out = open_to_all / "drop", open_to_all / "class"
    hand_in(ADA, packed(open_to_all, "a.zip", "first"), taking)
    hand_in(BOB, packed(open_to_all, "b.zip", "other"), taking)
    last = Path(hand_in(ADA, packed(open_to_all, "a.zip", "second"), taking))
    assert main(["collect", str(taking), "--out", str(out)]) == 0
    assert "2 students, 1 earlier files passed over, 0 not taken" in capsys.readouterr().out
    assert {path.name for path in out.iterdir()} == {
        f"user-{ADA}.zip",
        f"user-{BOB}.zip",
        "times.csv",
    }
    assert (out / f"user-{ADA}.zip").read_bytes() == last.read_bytes()
    rows = dict(csv.reader((out / "times.csv").open(encoding="utf-8")))
    assert rows[f"user-{ADA}.zip"].endswith("+00:00")


@as_root
def test_who_takes_work_back_after_it_was_collected_keeps_its_time(
    open_to_all: Path, capsys: pytest.CaptureFixture[str]
):
    taking, out = open_to_all / "drop", open_to_all / "class"
    late = Path(hand_in(BOB, packed(open_to_all, "b.zip", "late"), taking))
    assert main(["collect", str(taking), "--out", str(out)]) == 0
    time = dict(csv.reader((out / "times.csv").open(encoding="utf-8")))[f"user-{BOB}.zip"]
    as_user(BOB, late.unlink)
    hand_in(ADA, packed(open_to_all, "a.zip", "mine"), taking)
    capsys.readouterr()
    assert main(["collect", str(taking), "--out", str(out)]) == 0
    assert f"user-{BOB}.zip was collected before" in capsys.readouterr().err
    rows = dict(csv.reader((out / "times.csv").open(encoding="utf-8")))
    assert rows[f"user-{BOB}.zip"] == time
    (out / f"user-{BOB}.zip").unlink()
    assert main(["collect", str(taking), "--out", str(out)]) == 0
    rows = dict(csv.reader((out / "times.csv").open(encoding="utf-8")))
    assert set(rows) == {"file", f"user-{ADA}.zip"}


@as_root
def test_what_is_collected_is_nobody_elses_to_read(open_to_all: Path):
    taking, out = open_to_all / "drop", open_to_all / "class"
    hand_in(ADA, packed(open_to_all, "a.zip", "mine"), taking)
    before = os.umask(0o022)
    try:
        assert main(["collect", str(taking), "--out", str(out)]) == 0
    finally:
        os.umask(before)
    assert as_user(BOB, (out / f"user-{ADA}.zip").read_bytes).startswith("PermissionError")


@as_root
def test_names_are_not_to_be_trusted_where_files_have_several_owners(open_to_all: Path):
    taking = open_to_all / "drop"
    as_user(BOB, lambda: (taking / f"user-{ADA}_1_2.zip").write_bytes(b""))
    assert "--trust-names" in collect(taking, MB).left[0]
    hand_in(ADA, packed(open_to_all, "a.zip", "mine"), taking)
    [said] = collect(taking, MB).left
    assert said.endswith(f"it is called user-{ADA}'s and belongs to user-{BOB}")


@as_root
def test_neither_a_name_nor_a_time_can_be_forged(open_to_all: Path):
    taking = open_to_all / "drop"
    kept = Path(hand_in(ADA, packed(open_to_all, "a.zip", "mine"), taking))
    before = collect(taking, MB).newest[0].time
    as_user(ADA, lambda: os.utime(kept, (0, 0)))
    assert kept.stat().st_mtime == 0
    as_user(ADA, lambda: shutil.copy(kept, taking / f"user-{BOB}_1_2.zip"))
    as_user(BOB, lambda: os.symlink(kept, taking / f"user-{BOB}_3_4.zip"))
    as_user(BOB, lambda: os.mkfifo(taking / f"user-{BOB}_5_6.zip"))
    found = collect(taking, MB)
    assert [entry.login for entry in found.newest] == [f"user-{ADA}"]
    assert found.newest[0].time >= before
    assert [reason.partition(": ")[2][:20] for reason in found.left] == [
        "it is called user-64",
        "it is a link",
        "it is not a file",
    ]


@pytest.mark.parametrize(
    "name", [b"bad\xff_1_2.zip", b"a\nb_1_2.zip", b"_1_2.zip", b'a"b_1_2.zip', b"%ff_1_2.zip"]
)
@pytest.mark.parametrize("trust_names", [True, False])
def test_a_name_that_submit_never_gives_stops_nobody(
    tmp_path: Path, name: bytes, trust_names: bool, capsys: pytest.CaptureFixture[str]
):
    taking, out = tmp_path / "drop", tmp_path / "class"
    taking.mkdir()
    (taking / os.fsdecode(name)).write_bytes(b"x")
    (taking / f"{user_name()}_1_2.zip").write_bytes(b"x")
    trusting = ["--trust-names"] if trust_names else []
    assert main(["collect", str(taking), "--out", str(out), *trusting]) == 1
    assert "not made by submit()" in capsys.readouterr().err
    assert (out / f"{user_name()}.zip").exists()


def test_a_file_that_is_too_large_is_left_and_said(tmp_path: Path):
    (tmp_path / "ada_1_2.zip").write_bytes(b"x" * 2 * MB)
    found = collect(tmp_path, MB, trust_names=True)
    assert found.newest == ()
    assert "larger than 1 MB" in found.left[0]


def test_a_folder_that_is_not_there_is_wrong_usage(tmp_path: Path):
    with pytest.raises(UsageError, match="cannot be read"):
        collect(tmp_path / "none", MB)


@pytest.mark.parametrize(
    "logins",
    [
        ("ada_l", "ada-l"),
        ("ada l", "ada-l"),
        ("a+b", "a-b"),
        ("a/b", "a%2Fb"),
        ("müller", "muller"),
    ],
)
def test_different_logins_never_have_the_same_file(
    tmp_path: Path, logins: tuple[str, str], monkeypatch: pytest.MonkeyPatch
):
    """One student's work would replace the other's."""
    taking = tmp_path / "drop"
    taking.mkdir(mode=0o3773)
    taking.chmod(0o3773)
    for login in logins:
        monkeypatch.setenv("JUPYTERHUB_USER", login)
        drop(packed(tmp_path, "work.zip", login), taking)
    found = collect(taking, MB, trust_names=True)
    assert len(found.newest) == 2
    assert sorted(entry.login for entry in found.newest) == sorted(map(name_in_files, logins))
    assert found.earlier == 0


@pytest.mark.parametrize("login", ["..", ".", ".hidden", "../../etc"])
def test_no_login_leaves_the_folder_or_hides_in_it(login: str):
    assert not name_in_files(login).startswith(".")
    assert "/" not in name_in_files(login)


@pytest.mark.parametrize(
    ("login", "account"),
    [
        ("ada", "jupyter-ada"),
        ("ada_l", "jupyter-ada_l"),
        ("ada.lovelace@uni.example", "jupyter-ada.lovelace@uni.e-{hash}"),
    ],
)
def test_the_littlest_jupyterhub_puts_a_word_before_its_accounts(
    tmp_path: Path, login: str, account: str, monkeypatch: pytest.MonkeyPatch
):
    """Its users are `jupyter-LOGIN` to the system and `LOGIN` to themselves."""
    made = hashlib.sha256(f"jupyter-{login}".encode()).hexdigest()[:5]
    monkeypatch.setattr(drop_folder, "_owner", lambda user: account.format(hash=made))
    (tmp_path / f"{login}_20261128T000000Z_00000000.zip").write_bytes(b"x")
    (tmp_path / "bob_20261128T000000Z_00000000.zip").write_bytes(b"x")
    found = collect(tmp_path, MB)
    assert [entry.login for entry in found.newest] == [login]
    assert "it is called bob's and belongs to jupyter-" in found.left[0]
