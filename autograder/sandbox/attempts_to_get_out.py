"""What student code tries so as to get out of an isolation, before any that counts is run in it."""

from __future__ import annotations

import os
import time

from autograder.course import Course
from autograder.sandbox import seccomp
from autograder.sandbox.host import Host
from autograder.sandbox.notebook_limits import limits
from autograder.sandbox.own_folder import OwnFolder

_TRIAL_PROCESSES = 6
_TRIAL_BOMB = 66  # so many would mean that there is no limit; what the user runs may vary meanwhile
_TRIAL_SECONDS = 20.0
_CELL = """
import fcntl, os, shutil, socket, time
def attempt(action):
    try:
        return action()
    except (Exception, SystemExit) as error:
        return type(error).__name__
def bomb():
    children = []
    try:
        while len(children) < {bomb}:
            child = os.fork()
            if child == 0:
                time.sleep(60)
                os._exit(0)
            children.append(child)
    except OSError:
        pass
    return len(children) < {bomb}
def connect():
    with socket.socket() as line:
        line.settimeout(1)
        line.connect(("127.0.0.1", {port}))
    return True
def send_a_signal():
    try:
        os.kill({grader}, 0)
    except OSError:  # or else by owning a descriptor, whose owner can be sent any signal
        fcntl.fcntl(socket.socketpair()[0], fcntl.F_SETOWN, {grader})
    return True
def change_a_file():
    # The canary is the grader's: the right to change it must be refused, not only be missing, or
    # the call must do nothing.
    def state():
        found = [os.stat(path) for path in ({canary!r}, {folder!r})]
        return [(s.st_mode, s.st_mtime_ns, s.st_size, s.st_uid) for s in found]
    before = state()
    for change in (
        lambda: os.chmod({canary!r}, 0o777),
        lambda: os.chmod({folder!r}, 0),
        lambda: os.utime({canary!r}, (1, 1)),
        lambda: os.chown({canary!r}, os.getuid(), os.getgid()),
        lambda: os.setxattr({canary!r}, "user.trial", b"x"),
        lambda: os.truncate({canary!r}, 0),
        lambda: os.fchmod(os.open({canary!r}, os.O_RDONLY), 0o777),
        lambda: os.fchmod(os.open({canary!r}, os.O_PATH), 0o777),
        lambda: os.chmod("/proc/self/fd/%d" % os.open({canary!r}, os.O_PATH), 0o777),
    ):
        try:
            change()
        except OSError:
            pass
        if state() != before:
            return True
    return False
def call_the_kernel():
    # What no notebook has a use for; each call with arguments that can do no harm.
    import ctypes, platform
    libc = ctypes.CDLL(None, use_errno=True)
    for name, numbers in {refused!r}.items():
        number = numbers[platform.machine() == "aarch64"]
        if number is not None:
            ctypes.set_errno(0)
            libc.syscall(number, -1, -1, -1, -1, -1, -1)
            if ctypes.get_errno() not in (1, 38):
                return name
    return False
change_a_file = attempt(change_a_file)
call_the_kernel = attempt(call_the_kernel)
read_a_file = attempt(lambda: open({canary!r}).read())
write_a_file = attempt(lambda: open({canary!r}, "w").write("x"))
open_a_connection = attempt(connect)
signal_the_grader = attempt(send_a_signal)
start_a_program = attempt(lambda: os.execv("/bin/true", ["true"]))
def work():
    import numpy
    child = os.fork()
    if child == 0:
        os._exit(7)
    forked = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 7
    open("trial", "w").write("x")
    copied = open(shutil.copy("trial", "copy")).read() == "x"
    return forked and copied and numpy.arange(3).sum() == 3
works = attempt(work)
limited = attempt(bomb)
"""
# name: (what must have come out, what it means)
TRIALS = {
    "read_a_file": (("FileNotFoundError", "PermissionError"), "no file outside can be read"),
    "write_a_file": (
        ("FileNotFoundError", "PermissionError", "OSError"),
        "no file outside can be written",
    ),
    "change_a_file": (
        ("False", "FileNotFoundError"),
        "no mode, time or owner of a file outside can be changed",
    ),
    "call_the_kernel": (("False",), "calls to the kernel that no notebook needs are refused"),
    "open_a_connection": (
        ("PermissionError", "OSError", "ConnectionRefusedError"),
        "no connection can be opened",
    ),
    "signal_the_grader": (("ProcessLookupError", "PermissionError"), "the grader is out of reach"),
    "start_a_program": (("PermissionError", "FileNotFoundError"), "no program can be started"),
    "limited": (("True",), "the number of processes is limited"),
    "works": (
        ("True",),
        "numpy works, a process can be forked and files of one's own can be written and copied",
    ),
}


def try_to_get_out(host: Host, course: Course) -> dict[str, bool]:
    """Whether each of `TRIALS` holds in a host that was just started.

    Raises:
        HostError: if the host does not answer.
        Late: if the attempts do not come to an end.
    """
    import socket

    with OwnFolder() as folder, socket.socket() as listener:
        folder.chmod(0o755)
        canary = folder / "canary.txt"
        canary.write_text("secret")
        canary.chmod(0o666)
        state = canary.stat()
        before = (state.st_mode, state.st_mtime_ns, state.st_uid)
        listener.bind(("127.0.0.1", 0))
        listener.listen()
        cell = _CELL.format(
            canary=str(canary),
            folder=str(folder),
            refused=seccomp.TRIED if seccomp.build_filter() is not None else {},
            port=listener.getsockname()[1],
            grader=os.getpid(),
            bomb=_TRIAL_BOMB,
        )
        allowed = limits(course.settings)
        # Only the kernel's limit is tried: the zygote's own would end the trial.
        allowed["limits"] |= {"processes": _TRIAL_PROCESSES + 1, "spare": 16}
        allowed["usage"]["processes"] = 2 * _TRIAL_BOMB
        channel = host.open(allowed, seed=0)
        try:
            deadline = time.monotonic() + 6 * _TRIAL_SECONDS  # this machine may have much to do
            message: dict[str, object] = {
                "do": "run",
                "nonce": "trial",
                "cells": [cell],
                "names": list(TRIALS),
                "skip": {},
                "cell_seconds": _TRIAL_SECONDS,
                "seconds": _TRIAL_SECONDS,
            }
            channel.send(message, deadline)
            while "reply" not in (answer := channel.receive(deadline)):
                pass
        finally:
            channel.close()
        host.close()
        understood = answer["reply"]["understood"]
        untouched = canary.read_text() == "secret"
        state = canary.stat()
        unchanged = (state.st_mode, state.st_mtime_ns, state.st_uid) == before
    results = {name: understood.get(name) in expected for name, (expected, _) in TRIALS.items()}
    # What the attempt saw does not count: a file of that name in a private /tmp harms nobody.
    results["write_a_file"] = untouched
    results["change_a_file"] &= unchanged
    return results
