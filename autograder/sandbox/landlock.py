"""Landlock: which files a process and all it starts may still reach, decided by itself for good."""

from __future__ import annotations

import ctypes
import os
from collections.abc import Iterable

_CREATE, _ADD_RULE, _RESTRICT = 444, 445, 446  # the same numbers on every architecture

_WRITE_FILE, _READ_FILE, _READ_DIR = 1 << 1, 1 << 2, 1 << 3
_IOCTL_DEVICE = 1 << 15
_READ = _READ_FILE | _READ_DIR
# Write, remove and make folders, files and links; truncate. No devices, sockets, pipes, programs.
_CHANGE = _WRITE_FILE | 1 << 4 | 1 << 5 | 1 << 7 | 1 << 8 | 1 << 12 | 1 << 13 | 1 << 14
_ON_FILES = _WRITE_FILE | _READ_FILE | 1 << 14 | _IOCTL_DEVICE
_RIGHTS_BY_VERSION = {1: 13, 2: 14, 3: 15, 4: 15, 5: 16}  # how many file rights there are
_TCP_FROM, _SCOPES_FROM = 4, 6


class _Attributes(ctypes.Structure):
    _fields_ = [
        ("files", ctypes.c_uint64),
        ("network", ctypes.c_uint64),
        ("scopes", ctypes.c_uint64),
    ]


class _Beneath(ctypes.Structure):
    _pack_ = 1
    _fields_ = [("allowed", ctypes.c_uint64), ("folder", ctypes.c_int32)]


def version() -> int:
    """The version of Landlock here; 0 if there is none."""
    return max(0, _call(_CREATE, None, 0, 1, check=False))


def confines_signals() -> bool:
    """Whether Landlock here can keep signals inside."""
    return version() >= _SCOPES_FROM


class Ruleset:
    """A list of what may be read and what may be changed; everything else is refused."""

    def __init__(self, readable: Iterable[str], changeable: Iterable[str]) -> None:
        here = version()
        if here == 0:
            raise OSError("this kernel has no Landlock")
        self._handled = (1 << _RIGHTS_BY_VERSION.get(here, 16)) - 1
        attributes = _Attributes(
            self._handled,
            0b11 if here >= _TCP_FROM else 0,
            0b11 if here >= _SCOPES_FROM else 0,
        )
        size = 24 if here >= _SCOPES_FROM else 16 if here >= _TCP_FROM else 8
        self._descriptor = _call(_CREATE, ctypes.byref(attributes), size, 0)
        for path in readable:
            self._allow(path, _READ)
        for path in changeable:
            self._allow(path, _READ | _CHANGE)

    def _allow(self, path: str, rights: int) -> None:
        try:
            folder = os.open(path, os.O_PATH | os.O_CLOEXEC)
        except OSError:
            return  # what is not there need not be allowed
        try:
            if not os.path.isdir(path):
                rights &= _ON_FILES
            rule = _Beneath(rights & self._handled, folder)
            _call(_ADD_RULE, self._descriptor, 1, ctypes.byref(rule), 0)
        finally:
            os.close(folder)

    def apply(self) -> None:
        """Confine this process; no_new_privs must be set before.

        Raises:
            OSError: if the kernel refuses.
        """
        _call(_RESTRICT, self._descriptor, 0)
        os.close(self._descriptor)


def _call(number: int, *arguments: object, check: bool = True) -> int:
    libc = ctypes.CDLL(None, use_errno=True)
    libc.syscall.restype = ctypes.c_long
    plain = [ctypes.c_long(a) if isinstance(a, int) else a for a in arguments]
    result: int = libc.syscall(ctypes.c_long(number), *plain)
    if check and result < 0:
        number = ctypes.get_errno()
        raise OSError(number, f"Landlock: {os.strerror(number)}")
    return result
