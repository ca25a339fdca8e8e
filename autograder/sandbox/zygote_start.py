"""Starts a zygote: inside of bubblewrap, or beside the grader with Landlock and seccomp alone."""

from __future__ import annotations

import json
import os
import shutil
import socket
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from autograder.course import Settings
from autograder.course.folders import VISIBLE_FILES
from autograder.errors import AutograderError
from autograder.sandbox import bubblewrap, landlock, seccomp
from autograder.sandbox.compiled_libraries import font_folder
from autograder.sandbox.control_group import ControlGroup
from autograder.sandbox.student_environment import student_environment

_SYSTEM_FILES = ("/etc/ld.so.cache", "/etc/localtime")
_PACKAGE = Path(__file__).parents[1]
# A sandbox ends with the thread that started it; this one lives as long as the process.
_starter = ThreadPoolExecutor(1, "sandbox-starter")


class HostError(AutograderError):
    """A sandbox could not be started or does not answer; the sentence says why."""


@dataclass(frozen=True)
class Place:
    """What a zygote is started with: the course, and what it has for itself.

    ``folder`` holds the notebooks that were staged for it; ``identity`` is the number of a user of
    its own, or 0.
    """

    root: Path
    settings: Settings
    folder: Path
    identity: int
    group: ControlGroup


@dataclass(frozen=True)
class Zygote:
    """A zygote that was started: its process, its control socket, and its ``scratch`` folder.

    That is None where student code writes into memory, not on this machine's disk.
    """

    process: subprocess.Popen[bytes]
    control: socket.socket
    scratch: Path | None = None


def start_inside(place: Place) -> Zygote:
    """Start a zygote inside of bubblewrap.

    Raises:
        HostError: if bubblewrap is missing.
        OSError: if the machine does not allow it.
    """
    program = bubblewrap.find_bubblewrap()
    if program is None:
        raise HostError("bubblewrap is not installed.")
    fonts = font_folder()
    command = bubblewrap.command(
        program,
        root=place.root,
        package=_PACKAGE,
        notebooks=place.folder / "notebooks",
        fonts=fonts,
        size_mb=place.settings.files_mb,
        as_root=bool(place.identity),
    )
    set_up = {
        "scratch": str(bubblewrap.SCRATCH),
        "readable": ["/usr", "/lib", "/lib64", "/nix/store", "/etc", str(bubblewrap.COURSE)]
        + [str(folder) for folder in bubblewrap.interpreter_folders()],
        "notebooks": str(bubblewrap.COURSE / "notebooks"),
        "alone": True,
        "keep_reading": False,
    }
    environment = student_environment(bubblewrap.COURSE, bubblewrap.SCRATCH, place.settings)
    if fonts is not None:
        environment["AUTOGRADER_FONT_LIST"] = str(bubblewrap.FONTS)
    for name, value in environment.items():
        command += ["--setenv", name, value]
    return Zygote(*_start(place, [*command, "--"], set_up, {}))


def start_beside(place: Place) -> Zygote:
    """Start a zygote that Landlock, seccomp and limits alone will hold.

    Raises:
        HostError: if this kernel or processor lacks one of them.
        OSError: if the machine does not allow it.
    """
    root = place.root
    if landlock.version() == 0:
        raise HostError("This kernel has no Landlock.")
    if seccomp.build_filter() is None:
        raise HostError("There is no system call filter for this processor.")
    course, scratch = place.folder / "course", place.folder / "scratch"
    course.mkdir()
    scratch.mkdir()
    (course / "autograder").symlink_to(_PACKAGE)
    (place.folder / "notebooks").rename(course / "notebooks")
    if (root / "data").is_dir():
        (course / "data").symlink_to(root / "data")
    for name in VISIBLE_FILES:
        if (root / name).is_file():
            shutil.copy(root / name, course)
    if place.identity:
        os.chmod(place.folder, 0o711)
        os.chown(scratch, place.identity, place.identity)
    needed = [*bubblewrap.interpreter_folders(), _PACKAGE, (root / "data").resolve()]
    system = [Path(name) for name in ("/usr", "/lib", "/lib64", "/nix/store", *_SYSTEM_FILES)]
    hidden = [root.resolve(), *bubblewrap.installed_solutions()]
    readable = bubblewrap.leave_out([*system, *bubblewrap.interpreter_folders()], hidden)
    set_up = {
        "scratch": str(scratch),
        "readable": [str(folder) for folder in (course, *readable, *needed[-2:])],
        "notebooks": str(course / "notebooks"),
        "alone": False,
        # An interpreter in root's home folder is closed to any other user.
        "keep_reading": bool(place.identity) and any(map(_is_closed, needed)),
    }
    environment = student_environment(course, scratch, place.settings)
    fonts = font_folder()
    if fonts is not None:
        environment["AUTOGRADER_FONT_LIST"] = str(fonts)
    return Zygote(*_start(place, [], set_up, environment), scratch)


def _start(
    place: Place, prefix: list[str], set_up: dict[str, object], environment: dict[str, str]
) -> tuple[subprocess.Popen[bytes], socket.socket]:
    return _starter.submit(_start_process, place, prefix, set_up, environment).result()


def _start_process(
    place: Place, prefix: list[str], set_up: dict[str, object], environment: dict[str, str]
) -> tuple[subprocess.Popen[bytes], socket.socket]:
    ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    with theirs, open(place.folder / "errors", "wb") as errors:
        zygote = [sys.executable, "-P", "-m", "autograder.sandbox.inside.zygote"]
        process = subprocess.Popen(
            place.group.joining([*prefix, *zygote, str(theirs.fileno())]),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=errors,
            env=environment,
            cwd="/",
            pass_fds=[theirs.fileno()],
            start_new_session=True,
        )
    message = {
        **set_up,
        "identity": place.identity,
        "use_landlock": landlock.version() > 0,
        "use_seccomp": seccomp.build_filter() is not None,
    }
    with suppress(OSError):  # if it has ended already, `wait_until_ready` says so
        ours.send(json.dumps({"set up": message}).encode())
    return process, ours


def _is_closed(folder: Path) -> bool:
    """Whether others may not enter a folder or one above it."""
    return any(not parent.stat().st_mode & 1 for parent in (folder, *folder.parents))
