"""Attempts on what is beside a submission: another slot's processes and the class's work."""

import os
from collections.abc import Iterator

import pytest
from attacks import NUMBER, PATIENT, SECRET

from autograder.sandbox.launcher import Sandbox, Session
from autograder.sandbox.processes import descendants

pytestmark = pytest.mark.usefixtures("after_each_a_good_submission_gets_its_marks")


@pytest.fixture
def neighbor(sandbox: Sandbox) -> Iterator[Session]:
    """A session in another slot of the same kind, with a variable ``k``."""
    host = sandbox._tier.start()
    try:
        with Session(lambda: host, PATIENT, 2) as session:
            session.run(["k = 74"], [])
            yield session
    finally:
        host.stop()


def test_the_memory_of_no_other_process_can_be_read(lab, neighbor):
    others = [1, os.getpid(), *descendants(os.getpid())]
    assert len(others) >= 4
    code = f"""
import os
found = []
for process in [*{others}, os.getppid()]:
    if process != os.getpid():
        for name in ("mem", "environ", "maps", "cmdline", "fd", "root", "cwd", "task"):
            path = f"/proc/{{process}}/{{name}}"
            for read in (lambda: open(path, "rb").read(1), lambda: os.listdir(path)):
                try:
                    found.append((path, read()))
                except OSError:
                    pass
"""
    assert lab.value(code) == "[]"


def test_a_neighbors_process_can_be_neither_signalled_nor_owned(lab, neighbor):
    code = f"""
import ctypes, fcntl, os, signal, socket
libc = ctypes.CDLL(None, use_errno=True)
here, there = socket.socketpair()
found = []
for process in {descendants(os.getpid())}:
    for attempt in (
        lambda: os.kill(process, signal.SIGKILL),
        lambda: os.kill(-process, signal.SIGKILL),
        lambda: os.killpg(process, signal.SIGKILL),
        lambda: fcntl.fcntl(here, fcntl.F_SETOWN, process),
        lambda: os.setpriority(os.PRIO_PROCESS, process, 19),
        lambda: os.pidfd_open(process),
    ):
        try:
            found.append(attempt())
        except OSError:
            pass
    if process != os.getpid() and libc.syscall(234, process, process, 9) == 0:
        found.append("tgkill")
"""
    if os.uname().machine != "x86_64":
        code = code.replace("syscall(234", "syscall(131")
    assert lab.value(code) == "[]"
    assert neighbor.evaluate("k", NUMBER) == {"state": "given", "value": 74}


def test_the_work_of_the_class_cannot_be_reached_by_its_path(lab, tmp_path):
    work = tmp_path / "class"
    work.mkdir()
    (work / "lovelace.zip").write_text(SECRET)
    # As open as can be: the sandbox must not rely on modes.
    for path in (work / "lovelace.zip", work):
        path.chmod(0o777)
    for path in (tmp_path, *tmp_path.parents[:-2]):
        path.chmod(path.stat().st_mode | 0o055)
    code = f"""
import os, shutil
folder = {str(work)!r}
path = folder + "/lovelace.zip"
found = []
for attempt in (
    lambda: os.listdir(folder),
    lambda: open(path).read(),
    lambda: open(path, "w"),
    lambda: open(folder + "/mine.zip", "w"),
    lambda: os.unlink(path),
    lambda: os.rename(path, "stolen"),
    lambda: os.link(path, "stolen"),
    lambda: shutil.copy(path, "stolen"),
    lambda: [os.symlink(path, "stolen"), open("stolen").read()],
    lambda: [os.chdir(folder), os.listdir(".")],
):
    try:
        found.append(attempt())
    except OSError:
        pass
"""
    assert lab.value(code) == "[]"
    assert [path.name for path in work.iterdir()] == ["lovelace.zip"]
    assert (work / "lovelace.zip").read_text() == SECRET
