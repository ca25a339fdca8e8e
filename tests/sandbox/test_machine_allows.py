"""What this machine is short of stops the run with one sentence, and is nobody's mark."""

import os
import resource
import sqlite3
import subprocess
import sys
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import pytest

from autograder.errors import MachineError
from autograder.sandbox.host import Host
from autograder.sandbox.launcher import Sandbox
from autograder.sandbox.notebook_limits import limits
from tests.classroom import hand_in, make_course

LOW = {
    "ulimit -u": (resource.RLIMIT_NPROC, 30),
    "ulimit -n": (resource.RLIMIT_NOFILE, 64),
    "ulimit -v": (resource.RLIMIT_AS, 1500 * 2**20),
    "ulimit -f": (resource.RLIMIT_FSIZE, 2**20),
    "ulimit -t": (resource.RLIMIT_CPU, 60),
}
# Where a file system of 64 kB stands in place of a folder, as long as the command runs.
IN_A_SMALL_FOLDER = 'mount -t tmpfs -o "$0" small "$1" && shift && exec "$@"'


@pytest.fixture(scope="module")
def school(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = tmp_path_factory.mktemp("school")
    make_course(root / "course")
    for name in ("ada", "bob"):
        hand_in(root / "work", name)
    return root


def grade(
    school: Path,
    out: Path,
    before: list[str] | None = None,
    preexec: Callable[[], None] | None = None,
    **environment: str,
) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "autograder", "--course", str(school / "course")]
    command += ["grade", str(school / "work"), "--out", str(out)]
    return subprocess.run(
        [*(before or []), *command],
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=False,
        preexec_fn=preexec,
    )


def marks(out: Path) -> int:
    if not (out / "gradebook.db").exists() or not (out / "gradebook.db").stat().st_size:
        return 0
    with closing(sqlite3.connect(out / "gradebook.db")) as db:
        return int(db.execute("SELECT count(*) FROM mark").fetchone()[0])


def statuses(out: Path) -> set[str]:
    with closing(sqlite3.connect(out / "gradebook.db")) as db:
        return {row[0] for row in db.execute("SELECT mark ->> 'status' FROM mark")}


def check_stopped(done: subprocess.CompletedProcess[str], *words: str) -> None:
    assert done.returncode == 1, done.stdout + done.stderr
    last = done.stderr.strip().splitlines()[-1]
    assert last.startswith("autograder: "), done.stderr
    assert "Traceback" not in done.stderr
    for word in words:
        assert word in last


@pytest.mark.parametrize("name", LOW)
def test_a_limit_of_the_shell_that_is_lower_than_a_notebook_needs_is_named(school, tmp_path, name):
    kind, value = LOW[name]
    done = grade(school, tmp_path / "out", preexec=lambda: resource.setrlimit(kind, (value, value)))
    check_stopped(done, name, "then grade again")
    assert marks(tmp_path / "out") == 0


def test_a_soft_limit_is_raised_as_far_as_it_may_be(school, tmp_path):
    def lower() -> None:
        resource.setrlimit(resource.RLIMIT_NOFILE, (32, 1024))

    done = grade(school, tmp_path / "out", preexec=lower)
    assert done.returncode == 0, done.stderr
    assert statuses(tmp_path / "out") == {"right"}


def in_a_small_folder(options: str, folder: Path) -> list[str]:
    """A command before a command: whatever comes then sees another file system there."""
    folder.mkdir(exist_ok=True)
    inside = ["unshare", "--mount", "sh", "-c", IN_A_SMALL_FOLDER, options, str(folder)]
    if subprocess.run([*inside, "true"], capture_output=True, check=False).returncode:
        pytest.skip("nothing can be mounted here")
    return inside


@pytest.mark.parametrize("options", ["size=8k", "size=64k,nr_inodes=3"])
def test_a_temporary_folder_that_is_too_small_is_named(school, tmp_path, options):
    small = tmp_path / "small"
    before = in_a_small_folder(options, small)
    done = grade(school, tmp_path / "out", before, TMPDIR=str(small))
    check_stopped(done, str(small), "TMPDIR")
    assert marks(tmp_path / "out") == 0


@pytest.mark.parametrize("options", ["size=64k", "ro"])
def test_a_disk_that_takes_no_gradebook_is_named(school, tmp_path, options):
    small = tmp_path / "small"
    done = grade(school, small / "out", in_a_small_folder(options, small))
    check_stopped(done, str(small / "out"), "--out")


def test_a_disk_that_has_no_room_for_a_report_is_named(school, tmp_path):
    pages = tmp_path / "out/feedback"
    pages.parent.mkdir()
    done = grade(school, tmp_path / "out", in_a_small_folder("size=4k,nr_inodes=1", pages))
    check_stopped(done, str(pages), "no room left")


@pytest.mark.parametrize(
    ("options", "name"), [("noexec,size=200m", "TMPDIR"), ("ro", "HOME"), ("ro", "XDG_CACHE_HOME")]
)
def test_what_is_not_needed_may_be_missing(school, tmp_path, options, name):
    small = tmp_path / "small"
    before = in_a_small_folder(options, small)
    done = grade(school, tmp_path / "out", before, **{name: str(small)})
    assert done.returncode == 0, done.stderr
    assert statuses(tmp_path / "out") == {"right"}


def test_a_missing_dev_shm_changes_no_mark(school, tmp_path):
    if not Path("/dev/shm").is_dir():
        pytest.skip("it is missing here anyway")
    before = in_a_small_folder("ro,size=0", Path("/dev/shm"))
    done = grade(school, tmp_path / "out", before)
    assert done.returncode == 0, done.stderr
    assert statuses(tmp_path / "out") == {"right"}


def test_without_a_file_left_to_open_no_notebook_is_begun(course):
    host = Host(course.root, course.settings, with_namespaces=False)
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    try:
        host.wait_until_ready()
        taken = os.open(os.devnull, os.O_RDONLY)
        os.close(taken)
        resource.setrlimit(resource.RLIMIT_NOFILE, (taken, hard))
        with pytest.raises(MachineError, match="ulimit -n"):
            host.open(limits(course.settings), seed=1)
    finally:
        resource.setrlimit(resource.RLIMIT_NOFILE, (soft, hard))
        host.stop()


def test_a_notebook_that_cannot_be_confined_is_no_mark(course):
    hard = resource.getrlimit(resource.RLIMIT_NPROC)[1]
    if hard == resource.RLIM_INFINITY:
        pytest.skip("as many processes may be started here as anybody likes")
    asked = limits(course.settings)
    asked["limits"] |= {"processes": hard + 1}
    host = Host(course.root, course.settings, with_namespaces=False)
    try:
        with pytest.raises(MachineError, match="ulimit -u"):
            host.open(asked, seed=1)
        host.open(limits(course.settings), seed=1).close()  # and the sandbox itself goes on
    finally:
        host.stop()


def test_a_disk_with_less_room_than_a_notebook_may_use_is_named(course, monkeypatch):
    host = Host(course.root, course.settings, with_namespaces=False)
    real = os.statvfs(host._folder)
    full = os.statvfs_result([*real[:4], 3, *real[5:]])  # blocks that are left
    try:
        monkeypatch.setattr(os, "statvfs", lambda path: full)
        with pytest.raises(MachineError, match="files_mb"):
            host.open(limits(course.settings), seed=1)
    finally:
        host.stop()


def test_a_notebook_that_ends_itself_with_any_status_stops_nobody_else(course, sandbox: Sandbox):
    for status in (1, 70, 127):
        with sandbox.session() as session:
            report = session.run([f"import os\nos._exit({status})", "x = 1"], ["x"])
            assert report["understood"] == {"x": "1"}
            assert report["errors"] == ["killed", None]
