"""One zygote in its isolation, asked from the trusted side: the counterpart of `zygote`."""

from __future__ import annotations

import errno
import json
import os
import signal
import socket
import subprocess
import time
from contextlib import suppress
from pathlib import Path

from autograder.course import Settings
from autograder.errors import AutograderError, MachineError, machine_error, short_of
from autograder.exchange.channel import Channel
from autograder.exchange.messages import Message
from autograder.sandbox.compiled_libraries import compile_libraries_once
from autograder.sandbox.control_group import ControlGroup
from autograder.sandbox.own_folder import OwnFolder
from autograder.sandbox.own_user import OwnIdentity
from autograder.sandbox.staged_notebooks import stage
from autograder.sandbox.zygote_start import HostError, Place, start_beside, start_inside

_WARM_SECONDS = 120.0
_ANSWER_SECONDS = 15.0


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
        self._group = ControlGroup(settings)
        self._ended_before = 0  # by the kernel, for memory, in notebooks before this one
        try:
            stage(root, self._folder)
            compile_libraries_once()
            place = Place(root, settings, self._folder, self._identity, self._group)
            zygote = start_inside(place) if with_namespaces else start_beside(place)
        except BaseException as error:
            self._group.remove()
            self._own_folder.remove()
            self._own_identity.release()
            if isinstance(error, OSError | MemoryError | RuntimeError):
                short = machine_error(error, str(self._folder))
                raise short or HostError(f"The sandbox cannot be started: {error}.") from None
            raise
        self._process, self._control, self._scratch = zygote.process, zygote.control, zygote.scratch

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
