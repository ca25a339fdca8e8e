"""Starts a zygote under one kind of isolation and talks to it; the trusted side of `zygote`."""

from __future__ import annotations

import errno
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path

from autograder.course import Settings
from autograder.course.folders import VISIBLE_FILES
from autograder.errors import AutograderError, MachineError, machine_error, short_of
from autograder.exchange.channel import Channel
from autograder.exchange.messages import Message
from autograder.sandbox import bubblewrap, landlock, seccomp
from autograder.sandbox.compiled_libraries import compile_libraries, font_folder
from autograder.sandbox.control_group import ControlGroup
from autograder.sandbox.own_folder import OwnFolder
from autograder.sandbox.own_user import OwnIdentity
from autograder.sandbox.staged_notebooks import stage
from autograder.sandbox.student_environment import student_environment

_SYSTEM_FILES = ("/etc/ld.so.cache", "/etc/localtime")
_PACKAGE = Path(__file__).parents[1]
_WARM_SECONDS = 120.0
_ANSWER_SECONDS = 15.0
# A sandbox ends with the thread that started it; this one lives as long as the process.
_starter = ThreadPoolExecutor(1, "sandbox-starter")


class HostError(AutograderError):
    """A sandbox could not be started or does not answer; the sentence says why."""


class Host:
    """One zygote in its isolation.

    ``with_namespaces`` asks for bubblewrap; without, only Landlock, seccomp and limits hold student
    code.
    """

    def __init__(self, root: Path, settings: Settings, with_namespaces: bool) -> None:
        self._settings = settings
        self._number = 0
        self._ready = False
        self.is_stopped = False
        self._own_identity = OwnIdentity()
        self._identity = self._own_identity.number
        self._own_folder = OwnFolder()
        self._folder = self._own_folder.path
        self._scratch: Path | None = None  # where student code may write on this machine's disk
        self._group = ControlGroup(settings)
        self._ended_before = 0  # by the kernel, for memory, in notebooks before this one
        try:
            stage(root, self._folder)
            compile_libraries()
            start = self._start_inside if with_namespaces else self._start_beside
            self._process, self._control = start(root)
        except BaseException as error:
            self._group.remove()
            self._own_folder.remove()
            self._own_identity.release()
            if isinstance(error, OSError | MemoryError | RuntimeError):
                short = machine_error(error, str(self._folder))
                raise short or HostError(f"The sandbox cannot be started: {error}.") from None
            raise

    def wait_until_ready(self) -> None:
        """Wait until everything is imported.

        Raises:
            HostError: if it does not start.
            MachineError: if this machine is short of what it needs.
        """
        if self._ready:
            return
        message = self._hear(time.monotonic() + _WARM_SECONDS)
        if message != {"ready": True}:
            said = self._said()
            self.stop()
            short = self._short(message) or _short_by(said)
            raise short or HostError(f"The sandbox did not start: {said}")
        self._ready = True

    def open(self, limits: dict[str, object], seed: int) -> Channel:
        """Fork a child with an empty scratch folder and return the channel to it.

        Raises:
            HostError: if the zygote does not answer; then `stop` it.
            MachineError: if this machine is short of what a notebook may use.
        """
        self.wait_until_ready()
        self._require_room()
        self._number += 1
        self._ended_before = self._group.ended_for_memory()
        self._gone: Message | None = None
        try:
            ours, theirs = socket.socketpair()
        except OSError as error:
            raise machine_error(error) or error from None
        with theirs:
            message = {"start": self._number, "seed": seed, **limits}
            try:
                socket.send_fds(self._control, [json.dumps(message).encode()], [theirs.fileno()])
            except OSError:
                ours.close()
                raise HostError("The sandbox has ended.") from None
        try:
            self._expect("started")
        except AutograderError:
            ours.close()
            raise
        cap = int(self._settings.output_mb * 2**20)
        return Channel(ours, max_json=cap, max_arrays=cap)

    def close(self) -> float:
        """End the child and everything that it started; the seconds of its own that it had.

        Raises:
            HostError: if the zygote does not answer; then `stop` it.
        """
        self._tell({"end": self._number})
        return float(self._expect("ended").get("had", 0.0))

    def own_time(self, since: float) -> float | None:
        """The child's own seconds since a moment, as `OwnTime` counts; None if it has ended.

        Raises:
            HostError: if the zygote does not answer; then `stop` it.
        """
        self._tell({"time since": since})
        deadline = time.monotonic() + _ANSWER_SECONDS
        while (message := self._hear(deadline)) is not None:
            if "had" in message:
                return None if self._gone else float(message["had"])
            if message.get("gone") == self._number:
                self._gone = message
        raise HostError("The sandbox does not answer.")

    def interrupt(self, only_forks: bool) -> None:
        """End what the child has forked, or else interrupt what it does itself.

        Raises:
            HostError: if the zygote has ended.
        """
        self._tell({"interrupt": self._number, "only_forks": only_forks})

    def end_leftovers(self, only_orphans: bool) -> None:
        """End what the child has started and not waited for, so that it costs nothing after it.

        With ``only_orphans`` the fork that evaluates a response may end by itself.

        Raises:
            HostError: if the zygote does not answer; then `stop` it.
        """
        self._tell({"end leftovers": self._number, "only_orphans": only_orphans})
        deadline = time.monotonic() + _ANSWER_SECONDS
        while (message := self._hear(deadline)) is not None:
            if message.get("no leftovers") == self._number:
                return
            if message.get("gone") == self._number:
                self._gone = message
        raise HostError("The sandbox does not answer.")

    def why_gone(self, seconds: float) -> str | None:
        """Why the child ended by itself, if the kernel or the zygote says so within some time."""
        if self._group.ended_for_memory() > self._ended_before:
            return f"it used more than {self._settings.memory_mb} MB of memory"
        message = self._gone or self._hear(time.monotonic() + seconds)
        if message is not None and message.get("gone") == self._number:
            return str(message["why"])
        return None

    @property
    def has_control_group(self) -> bool:
        """Whether the kernel counts what everything in here uses together."""
        return self._group.path is not None

    @property
    def control(self) -> socket.socket:
        """The control socket; something to read there means that the child has ended."""
        return self._control

    def stop(self) -> None:
        """End the zygote and everything in it."""
        self.is_stopped = True
        with suppress(OSError):
            self._control.shutdown(socket.SHUT_RDWR)
        try:
            self._process.wait(2.0)
        except subprocess.TimeoutExpired:
            with suppress(ProcessLookupError, PermissionError):
                os.killpg(self._process.pid, signal.SIGKILL)
            self._process.wait()
        self._control.close()
        self._group.remove()
        self._own_folder.remove()
        self._own_identity.release()

    def _tell(self, message: dict[str, object]) -> None:
        try:
            self._control.send(json.dumps(message).encode())
        except OSError:
            raise HostError("The sandbox has ended.") from None

    def _expect(self, word: str) -> Message:
        deadline = time.monotonic() + _ANSWER_SECONDS
        while True:
            message = self._hear(deadline)
            if message is None:
                raise HostError("The sandbox does not answer.")
            if message.get(word) == self._number:
                return message
            if message.get("not started") == self._number:
                short = self._short(message)
                raise short or HostError(f"A notebook could not be started: {self._said()}")

    def _hear(self, deadline: float) -> Message | None:
        self._control.settimeout(max(0.0, deadline - time.monotonic()) or 0.001)
        try:
            data = self._control.recv(2**16)
        except OSError:
            return None
        return dict(json.loads(data)) if data else None

    def _require_room(self) -> None:
        """Refuse to begin where the disk has less room than a notebook may use."""
        if self._scratch is None:
            return  # it is in memory, and has a size of its own
        state = os.statvfs(self._scratch)
        too_few = state.f_files > 0 and state.f_favail < self._settings.files
        if too_few or state.f_bavail * state.f_frsize < self._settings.files_mb * 2**20:
            raise MachineError(
                f"A notebook may write {self._settings.files_mb} MB in {self._settings.files} "
                f"files, and there is less room than that in {self._scratch.parent.parent}. Make "
                "room there, name another folder with TMPDIR, or allow less (files_mb in "
                "[tool.autograder]); then grade again."
            )

    def _short(self, message: Message | None) -> MachineError | None:
        number = (message or {}).get("short")
        return short_of(number, str((message or {})["where"])) if number else None

    def _said(self) -> str:
        """The last line that the process wrote about its end."""
        text = (
            (self._folder / "errors").read_text(errors="replace") if self._folder.exists() else ""
        )
        lines = [line for line in text.splitlines() if line.strip()]
        return lines[-1][:300] if lines else "it gave no reason."

    def _start_inside(self, root: Path) -> tuple[subprocess.Popen[bytes], socket.socket]:
        program = bubblewrap.find_bubblewrap()
        if program is None:
            raise HostError("bubblewrap is not installed.")
        fonts = font_folder()
        command = bubblewrap.command(
            program,
            root=root,
            package=_PACKAGE,
            notebooks=self._folder / "notebooks",
            fonts=fonts,
            size_mb=self._settings.files_mb,
            as_root=bool(self._identity),
        )
        set_up = {
            "scratch": str(bubblewrap.SCRATCH),
            "readable": ["/usr", "/lib", "/lib64", "/nix/store", "/etc", str(bubblewrap.COURSE)]
            + [str(folder) for folder in bubblewrap.interpreter_folders()],
            "notebooks": str(bubblewrap.COURSE / "notebooks"),
            "alone": True,
            "keep_reading": False,
        }
        environment = student_environment(bubblewrap.COURSE, bubblewrap.SCRATCH, self._settings)
        if fonts is not None:
            environment["AUTOGRADER_FONT_LIST"] = str(bubblewrap.FONTS)
        for name, value in environment.items():
            command += ["--setenv", name, value]
        return self._start([*command, "--"], set_up, {})

    def _start_beside(self, root: Path) -> tuple[subprocess.Popen[bytes], socket.socket]:
        if landlock.version() == 0:
            raise HostError("This kernel has no Landlock.")
        if seccomp.build_filter() is None:
            raise HostError("There is no system call filter for this processor.")
        course, scratch = self._folder / "course", self._folder / "scratch"
        course.mkdir()
        scratch.mkdir()
        (course / "autograder").symlink_to(_PACKAGE)
        (self._folder / "notebooks").rename(course / "notebooks")
        if (root / "data").is_dir():
            (course / "data").symlink_to(root / "data")
        for name in VISIBLE_FILES:
            if (root / name).is_file():
                shutil.copy(root / name, course)
        self._scratch = scratch
        if self._identity:
            os.chmod(self._folder, 0o711)
            os.chown(scratch, self._identity, self._identity)
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
            "keep_reading": bool(self._identity) and any(map(_is_closed, needed)),
        }
        environment = student_environment(course, scratch, self._settings)
        fonts = font_folder()
        if fonts is not None:
            environment["AUTOGRADER_FONT_LIST"] = str(fonts)
        return self._start([], set_up, environment)

    def _start(
        self, prefix: list[str], set_up: dict[str, object], environment: dict[str, str]
    ) -> tuple[subprocess.Popen[bytes], socket.socket]:
        return _starter.submit(self._start_process, prefix, set_up, environment).result()

    def _start_process(
        self, prefix: list[str], set_up: dict[str, object], environment: dict[str, str]
    ) -> tuple[subprocess.Popen[bytes], socket.socket]:
        ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with theirs, open(self._folder / "errors", "wb") as errors:
            zygote = [sys.executable, "-P", "-m", "autograder.sandbox.inside.zygote"]
            process = subprocess.Popen(
                self._group.joining([*prefix, *zygote, str(theirs.fileno())]),
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
            "identity": self._identity,
            "use_landlock": landlock.version() > 0,
            "use_seccomp": seccomp.build_filter() is not None,
        }
        with suppress(OSError):  # if it has ended already, `wait_until_ready` says so
            ours.send(json.dumps({"set up": message}).encode())
        return process, ours


def _short_by(said: str) -> MachineError | None:
    """What the last words of a process that did not start say about this machine."""
    if "MemoryError" in said or os.strerror(errno.ENOMEM) in said:
        return short_of(errno.ENOMEM)
    if os.strerror(errno.EMFILE) in said:
        return short_of(errno.EMFILE)
    # From bubblewrap these mean that no namespace can be made, which is a matter of rights.
    if not said.startswith("bwrap:"):
        for number in (errno.ENOSPC, errno.EAGAIN):
            if os.strerror(number) in said:
                return short_of(number)
    return None


def _is_closed(folder: Path) -> bool:
    """Whether others may not enter a folder or one above it."""
    return any(not parent.stat().st_mode & 1 for parent in (folder, *folder.parents))
