"""A seccomp filter: system calls that student code has no use for fail with "not permitted".

What is refused: other processes (ptrace, kill, signals through a descriptor's owner), programs
(execve), the network, mounts, namespaces, memory and queues that no limit counts or that outlive a
process, priorities, the owners of files and their extended attributes, and the kernel's wider
surface. Where no file system of its own hides the instructor's files, the modes and times of files,
which Landlock does not govern, stay as they are: the calls that change them succeed and do nothing,
since honest work that copies a file (`shutil.copy`) makes them too. Calls younger than this list do
not exist in here. What is left is what Python, NumPy and matplotlib need.
"""

from __future__ import annotations

import ctypes
import errno
import platform
import struct

from autograder.sandbox.refused_calls import REFUSED

# By path or by descriptor.
_FILE_MODES_AND_TIMES: dict[str, tuple[int | None, int | None]] = {
    "chmod": (90, None),
    "fchmod": (91, 52),
    "fchmodat": (268, 53),
    "fchmodat2": (452, 452),
    "utime": (132, None),
    "utimes": (235, None),
    "futimesat": (261, None),
    "utimensat": (280, 88),
}
# Of a file that is named; `ftruncate` stays, since its descriptor had to be opened for writing.
_TRUNCATE = (76, 45)
# What the trial of a kind of isolation calls: a sample of each family.
TRIED = {
    name: REFUSED[name]
    for name in (
        "bpf",
        "fchownat",
        "fsetxattr",
        "io_uring_setup",
        "kcmp",
        "keyctl",
        "landlock_create_ruleset",
        "landlock_restrict_self",
        "memfd_create",
        "mount",
        "mount_setattr",
        "perf_event_open",
        "pidfd_getfd",
        "pidfd_open",
        "process_vm_readv",
        "process_vm_writev",
        "ptrace",
        "setns",
        "unshare",
        "userfaultfd",
    )
}
_YOUNGEST = 470  # the first number of a call that was not yet there when this list was made
_CLONE, _CLONE3, _IOCTL, _PRLIMIT, _TGKILL = (56, 220), (435, 435), (16, 29), (302, 261), (234, 131)
_MMAP, _FCNTL, _PRCTL = (9, 222), (72, 25), (157, 167)
_SET_DUMPABLE = 4
_NAMESPACES = 0x7E020000  # every CLONE_NEW... flag that clone knows
_TYPING = (0x5412, 0x541C, 0x5423)  # TIOCSTI, TIOCLINUX, TIOCSETD: typing into a terminal
# Who owns a descriptor is sent any signal that is set for it, a kill without `kill`:
_OWNING_BY_IOCTL = (0x8901, 0x8902)  # FIOSETOWN, SIOCSPGRP
_OWNING_BY_FCNTL = (8, 10, 15)  # F_SETOWN, F_SETSIG, F_SETOWN_EX
_MAP_SHARED, _MAP_ANONYMOUS = 0x01, 0x20
_ARCHITECTURES = {"x86_64": (0xC000003E, 0), "aarch64": (0xC00000B7, 1)}
_X32 = 0x40000000

_LOAD, _EQUAL, _AT_LEAST, _ANY_BIT, _RETURN = 0x20, 0x15, 0x35, 0x45, 0x06
_ALLOW, _KILL = 0x7FFF0000, 0x80000000
_AT_NUMBER, _AT_ARCHITECTURE, _AT_ARGUMENTS = 0, 4, 16


def build_filter(
    refuse_thread_signals: bool = False, keep_modes_and_times: bool = False
) -> bytes | None:
    """The filter's program for this machine, or None for a processor that is not known.

    ``refuse_thread_signals`` also refuses tgkill, for kernels that cannot confine signals, and
    ``keep_modes_and_times`` lets those of files stay as they are, for where the files of the
    instructor can be named.
    """
    known = _ARCHITECTURES.get(platform.machine())
    if known is None:
        return None
    architecture, column = known
    refuse, absent, do_nothing = _fail(errno.EPERM), _fail(errno.ENOSYS), _fail(0)
    numbers = [entry[column] for entry in REFUSED.values() if entry[column] is not None]
    kept = [entry[column] for entry in _FILE_MODES_AND_TIMES.values()]
    if keep_modes_and_times:
        numbers.append(_TRUNCATE[column])
    if refuse_thread_signals:
        numbers.append(_TGKILL[column])
    program = [
        _do(_LOAD, _AT_ARCHITECTURE),
        _do(_EQUAL, architecture, then=1),
        _do(_RETURN, _KILL),
        _do(_LOAD, _AT_NUMBER),
    ]
    if column == 0:  # the x32 calls are the same ones under other numbers
        program += [_do(_AT_LEAST, _X32, otherwise=1), refuse]
    program += [_do(_AT_LEAST, _YOUNGEST, otherwise=1), absent]
    for number in numbers:
        program += [_do(_EQUAL, int(number or 0), otherwise=1), refuse]
    for number in kept if keep_modes_and_times else ():
        if number is not None:
            program += [_do(_EQUAL, number, otherwise=1), do_nothing]
    # The C library falls back to clone, whose flags can be looked at.
    program += [_do(_EQUAL, _CLONE3[column], otherwise=1), absent]
    program += _for_call(
        _CLONE[column],
        [_load_argument(0), _do(_ANY_BIT, _NAMESPACES, otherwise=1), refuse],
    )
    for call, commands in (
        (_IOCTL[column], _TYPING + _OWNING_BY_IOCTL),
        (_FCNTL[column], _OWNING_BY_FCNTL),
    ):
        checks = [_load_argument(1)]
        for command in commands:
            checks += [_do(_EQUAL, command, otherwise=1), refuse]
        program += _for_call(call, checks)
    program += _for_call(  # its own limits only
        _PRLIMIT[column], [_load_argument(0), _do(_EQUAL, 0, then=1), refuse]
    )
    # The zygote must go on seeing what its children hold.
    program += _for_call(
        _PRCTL[column], [_load_argument(0), _do(_EQUAL, _SET_DUMPABLE, otherwise=1), refuse]
    )
    # Pages of shared memory that no process has mapped at the moment are in no process's count.
    program += _for_call(
        _MMAP[column],
        [
            _load_argument(3),
            _do(_ANY_BIT, _MAP_ANONYMOUS, otherwise=2),
            _do(_ANY_BIT, _MAP_SHARED, otherwise=1),
            refuse,
        ],
    )
    program += [_do(_RETURN, _ALLOW)]
    return b"".join(program)


def install(program: bytes) -> None:
    """Put this process and all it starts under the filter; no_new_privs must be set before.

    Raises:
        OSError: if the kernel refuses.
    """

    class Program(ctypes.Structure):
        _fields_ = [("length", ctypes.c_ushort), ("filter", ctypes.c_void_p)]

    libc = ctypes.CDLL(None, use_errno=True)
    buffer = ctypes.create_string_buffer(program, len(program))
    described = Program(len(program) // 8, ctypes.addressof(buffer))
    pr_set_seccomp, mode_filter = 22, 2
    if libc.prctl(pr_set_seccomp, mode_filter, ctypes.byref(described), 0, 0) != 0:
        raise OSError(ctypes.get_errno(), "seccomp")


def _do(code: int, value: int, then: int = 0, otherwise: int = 0) -> bytes:
    return struct.pack("=HBBI", code, then, otherwise, value)


def _load_argument(index: int) -> bytes:
    """Load the low half of an argument: all that the kernel looks at in those compared here."""
    return _do(_LOAD, _AT_ARGUMENTS + 8 * index)


def _for_call(number: int, checks: list[bytes]) -> list[bytes]:
    """Checks for one call only, which is allowed if none of them returns."""
    checks = [*checks, _do(_RETURN, _ALLOW)]
    return [_do(_EQUAL, number, otherwise=len(checks)), *checks]


def _fail(number: int) -> bytes:
    return _do(_RETURN, 0x00050000 | number)
