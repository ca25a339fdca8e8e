"""The third belt: a control group for each sandbox, where this machine lets its user make one."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from attacks import CASE, LIMITS
from msgspec.structs import replace

from autograder.course import Course
from autograder.sandbox import control_group
from autograder.sandbox.control_group import ControlGroup, parent_group
from autograder.sandbox.host import Host
from autograder.sandbox.launcher import Sandbox, Session, Stopped

# Here as a list of files: what a kernel with version 2 shows, for machines that have none.
CAN_LIMIT = "cpu memory pids"


@pytest.fixture
def tree(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The root of a tree of groups; this process is in /slice/scope."""
    process, top = tmp_path / "self", tmp_path / "the groups"
    process.mkdir()
    (process / "cgroup").write_text("8:pids:/other\n0::/slice/scope\n")
    shown = str(top).replace(" ", "\\040")
    (process / "mountinfo").write_text(
        f"20 1 0:19 / /sys rw - sysfs sysfs rw\n29 20 0:26 / {shown} rw,nosuid - cgroup2 none rw\n"
    )
    monkeypatch.setattr(control_group, "_PROCESS", process)
    for group in (top, top / "slice", top / "slice" / "scope"):
        group.mkdir()
        (group / "cgroup.controllers").write_text(CAN_LIMIT)
        (group / "cgroup.subtree_control").write_text("")
        (group / "cgroup.procs").write_text("1\n")
        (group / "cgroup.type").write_text("domain")
    return top


def test_the_nearest_group_whose_groups_have_limits_is_taken(tree: Path):
    (tree / "cgroup.subtree_control").write_text("memory pids")
    (tree / "slice" / "cgroup.subtree_control").write_text("cpu memory pids")
    assert parent_group() == tree / "slice"


def test_a_group_that_limits_memory_alone_is_of_no_use(tree: Path):
    (tree / "slice" / "cgroup.subtree_control").write_text("memory")
    assert parent_group() is None
    assert ControlGroup(LIMITS).path is None


def test_a_group_of_our_own_is_opened_from_a_group_below_it(tree: Path):
    scope = tree / "slice" / "scope"
    (scope / "cgroup.procs").write_text(f"{os.getpid()}\n")
    assert parent_group() == scope
    assert (scope / "autograder-itself" / "cgroup.procs").read_text() == "0"
    assert (scope / "cgroup.subtree_control").read_text() == "+cpu"  # the last that was written


def test_others_are_not_moved(tree: Path):
    scope = tree / "slice" / "scope"
    (scope / "cgroup.procs").write_text(f"{os.getpid()}\n4711\n")
    assert parent_group() is None
    assert not (scope / "autograder-itself").exists()


def test_the_root_of_all_groups_needs_no_group_below_it(tree: Path):
    (tree / "cgroup.type").unlink()
    assert parent_group() == tree


def test_a_sandbox_may_have_what_a_notebook_may_and_what_is_beside_it(tree: Path):
    (tree / "slice" / "cgroup.subtree_control").write_text(CAN_LIMIT)
    group = ControlGroup(replace(LIMITS, memory_mb=100, files_mb=10, processes=5))
    assert group.path is not None
    assert int((group.path / "memory.max").read_text()) > 110 * 2**20
    assert int((group.path / "pids.max").read_text()) > 5
    assert not (group.path / "memory.swap.max").exists()  # this kernel has no swap


def test_a_command_joins_before_it_begins(tree: Path):
    (tree / "slice" / "cgroup.subtree_control").write_text(CAN_LIMIT)
    group = ControlGroup(LIMITS)
    assert group.path is not None
    command = group.joining(["/bin/echo", "two words", "$HOME"])
    said = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    assert said == "two words $HOME\n"
    assert (group.path / "cgroup.procs").read_text() == "0\n"


def test_a_command_that_cannot_join_does_not_begin(tree: Path):
    (tree / "slice" / "cgroup.subtree_control").write_text(CAN_LIMIT)
    group = ControlGroup(LIMITS)
    assert group.path is not None
    group.path = group.path / "gone"
    ended = subprocess.run(group.joining(["/bin/echo", "hello"]), capture_output=True, check=False)
    assert ended.returncode
    assert not ended.stdout


def test_processes_that_the_kernel_ended_for_memory_are_counted(tree: Path):
    (tree / "slice" / "cgroup.subtree_control").write_text(CAN_LIMIT)
    group = ControlGroup(LIMITS)
    assert group.path is not None
    assert group.ended_for_memory() == 0
    (group.path / "memory.events").write_text("low 0\noom 3\noom_kill 2\noom_group_kill 0\n")
    assert group.ended_for_memory() == 2


def test_groups_that_a_killed_grader_left_are_removed(tree: Path):
    (tree / "slice" / "cgroup.subtree_control").write_text(CAN_LIMIT)
    left, new = tree / "slice" / "autograder-left", tree / "slice" / "autograder-new"
    left.mkdir()
    new.mkdir()
    os.utime(left, (1, 1))
    ControlGroup(LIMITS)
    assert not left.exists()
    assert new.exists()


# From here on with the kernel's own groups.

needs_groups = pytest.mark.skipif(
    sys.platform != "linux" or parent_group() is None,
    reason="no control groups of version 2 with limits can be made on this machine",
)
# Nothing here counts for a process: what fills the memory are the kernel's own tables and buffers.
PIPES = """
import os, time
def double(x):
    for _ in range(30):
        if os.fork() == 0:
            kept = [os.pipe() for _ in range(100)]
            for _, end in kept:
                os.set_blocking(end, False)
                try:
                    while True:
                        os.write(end, b"x" * 65536)
                except BlockingIOError:
                    pass
            time.sleep(60)
            os._exit(0)
    time.sleep(60)
"""


@needs_groups
def test_what_runs_in_a_sandbox_is_in_its_group_which_ends_with_it(course: Course):
    host = Host(course.root, course.settings, with_namespaces=False)
    try:
        host.wait_until_ready()
        assert host.has_control_group
        group = host._group.path
        assert group is not None
        assert str(host._process.pid) in (group / "cgroup.procs").read_text().split()
    finally:
        host.stop()
    assert not group.exists()


@needs_groups
@pytest.mark.usefixtures("after_each_a_good_submission_gets_its_marks")
def test_what_the_kernel_holds_for_a_notebook_is_counted_too(sandbox: Sandbox):
    roomy = replace(LIMITS, cell_seconds=30, question_seconds=30, notebook_seconds=90)
    host = sandbox._take_host()
    group = host._group.path
    assert group is not None
    used = int((group / "memory.current").read_text())
    before = (group / "memory.max").read_text()
    (group / "memory.max").write_text(str(used + 64 * 2**20))
    try:
        with Session(lambda: host, roomy, 1) as session:
            session.run([PIPES], [])
            with pytest.raises(Stopped) as stopped:
                session.evaluate("double", CASE)
    finally:
        if group.exists():
            (group / "memory.max").write_text(before)
    assert stopped.value.status == "killed"
    assert "MB of memory" in stopped.value.why
