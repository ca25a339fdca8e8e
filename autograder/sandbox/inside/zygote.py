"""The trusted process inside the sandbox: has everything imported, and forks a child per notebook.

``python -m autograder.sandbox.inside.zygote DESCRIPTOR`` obeys small JSON messages on a control
socket that student code never gets:

- first ``{"set up": {...}}`` (see `SetUp`); the answer ``{"ready": true}`` comes when it is warm.
- ``{"start": number, "limits": {...}, "seed": ...}`` with a socket: clears what an earlier child
  left, forks a child that serves this socket, answers ``{"started": number}`` when it is confined.
  If it cannot be, no student code has run: ``{"not started": number, "short": ..., "where": ...}``
  says what this machine is short of.
- ``{"end": number}``: ends the child and all it started, answers ``{"ended": number, "had": ...}``
  with the seconds of its own that it had.

- ``{"time since": moment}`` answers ``{"had": seconds}``, as `OwnTime` counts them.
- ``{"interrupt": number, "only_forks": ...}`` ends what the child has forked, or sends the child
  itself an alarm.
- ``{"end leftovers": number, "only_orphans": ...}`` ends all that the child has started and not
  waited for, or only what outlived a fork of it, answers ``{"no leftovers": number}``.

If the child ends by itself or is ended for what it uses, ``{"gone": number, "why": ...}`` comes
unasked. When the control socket closes, everything ends. No key and no hidden input is ever here.
"""

from __future__ import annotations

import errno
import gc
import json
import os
import select
import shutil
import signal
import socket
import sys
import traceback
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

from autograder.exchange.messages import Message
from autograder.sandbox import landlock, lockdown, seccomp
from autograder.sandbox.empty_folder import empty
from autograder.sandbox.inside.notebook_child import prepare_process, serve
from autograder.sandbox.inside.warm_imports import warm
from autograder.sandbox.notebook_usage import Usage
from autograder.sandbox.own_time import OwnTime
from autograder.sandbox.processes import descendants, end_all_others, end_leftovers, tasks_of
from autograder.sandbox.stop_errors import BY_SIGNAL

_CONFINED = b"confined"
_ZYGOTE_IS_TAKEN, _CHILD_IS_TAKEN = 900, 1000  # of 1000: what the kernel ends first for memory
_TICK = 0.05  # seconds between two looks at what the child uses


@dataclass(frozen=True)
class SetUp:
    """How this sandbox is built.

    ``scratch`` is the only folder that may be written, ``readable`` what may be read,
    ``notebooks`` the folder whose files stand in the working folder. ``identity`` is the user id
    to change to, or 0. ``alone`` says that no process but ours can be seen or signalled,
    ``keep_reading`` is as in `drop_rights`.
    """

    scratch: str
    readable: list[str]
    notebooks: str
    identity: int
    alone: bool
    keep_reading: bool
    use_landlock: bool
    use_seccomp: bool


class Zygote:
    """Holds what every child starts with."""

    def __init__(self, control: socket.socket) -> None:
        self._control = control
        self._child = 0
        self._number = 0
        self._own_time = OwnTime()
        self._wake, wake_write = os.pipe()
        os.set_blocking(self._wake, False)
        os.set_blocking(wake_write, False)
        signal.set_wakeup_fd(wake_write, warn_on_full_buffer=False)
        signal.signal(signal.SIGCHLD, lambda number, frame: None)

    def set_up(self, how: SetUp) -> None:
        """Take a lesser identity, import everything, and hide."""
        self._how = how
        lockdown.drop_rights(how.identity, how.keep_reading)
        if not how.alone:
            lockdown.adopt_orphans()
        _be_taken_first(_ZYGOTE_IS_TAKEN)
        self._work = Path(how.scratch) / "work"
        self._sweep()
        _bring_font_list()
        os.chdir(self._work / "notebooks")
        self._notebook = warm(with_course=True)
        os.environ.pop("LD_LIBRARY_PATH", None)  # set by OpenCV, and names its folder
        gc.freeze()  # the collector would write into every page and so copy it in each fork
        self._filter = (
            seccomp.build_filter(
                refuse_thread_signals=not landlock.confines_signals(),
                # Files outside can be named here, and Landlock governs neither.
                keep_modes_and_times=not how.alone,
            )
            if how.use_seccomp
            else None
        )
        lockdown.hide_memory()
        self._usage = Usage(self._work, how.alone)

    def serve(self) -> None:
        """Obey until the control socket closes."""
        poll = select.poll()
        poll.register(self._control, select.POLLIN)
        poll.register(self._wake, select.POLLIN)
        while True:
            poll.poll(_TICK * 1000 if self._child else None)
            with suppress(BlockingIOError):
                while os.read(self._wake, 4096):
                    pass
            self._reap()
            if self._child:
                self._look_at_usage()
            ready, _, _ = select.select([self._control], [], [], 0)
            if ready and not self._obey():
                break
        self._sweep()

    def _obey(self) -> bool:
        data, descriptors, _, _ = socket.recv_fds(self._control, 2**16, 1)
        if not data:
            return False
        message = json.loads(data)
        if "set up" in message:
            try:
                self.set_up(SetUp(**message["set up"]))
            except (OSError, MemoryError) as error:
                self._say({"not ready": True, **_short_of(error)})
                raise
            self._say({"ready": True})
        elif "start" in message:
            self._number = message["start"]
            try:
                self._sweep()
                self._start(message, descriptors[0])
            except (OSError, MemoryError) as error:
                self._say({"not started": self._number, **_short_of(error)})
            else:
                self._say({"started": self._number})
        elif "time since" in message:
            self._own_time.look(self._usage.processes())
            self._say({"had": self._own_time.since(message["time since"])})
        elif "interrupt" in message:
            if message["interrupt"] == self._number:
                self._interrupt(message["only_forks"])
        elif "end leftovers" in message:
            if self._child and message["end leftovers"] == self._number:
                end_leftovers(self._child, self._usage.processes, message["only_orphans"])
            self._say({"no leftovers": message["end leftovers"]})
        elif "end" in message:
            self._own_time.look(self._usage.processes())
            self._sweep()
            self._say({"ended": message["end"], "had": self._own_time.since(0.0)})
        return True

    def _start(self, message: Message, descriptor: int) -> None:
        """Fork a child and wait until it is confined.

        Raises:
            OSError: if it cannot be; that is never the student's doing, whose code has not run.
        """
        limits = lockdown.Limits(**message["limits"])
        if not self._how.alone and not self._how.identity:  # as the instructor, who runs more
            limits = limits.beside(tasks_of(os.getuid()))
        self._own_time.begin()
        self._usage.begin(message["usage"])
        reading, writing = os.pipe()
        try:
            child = os.fork()
            if child == 0:
                self._run_child(limits, message["seed"], descriptor, writing)
            os.close(writing)
            writing = -1
            said = os.read(reading, 4096)
        finally:
            os.close(descriptor)
            os.close(reading)
            if writing >= 0:
                os.close(writing)
        if said != _CONFINED:
            failure = json.loads(said or b"{}")
            raise OSError(
                failure.get("short") or errno.EAGAIN, "not confined", failure.get("where")
            )
        self._child = child
        lockdown.give_way(child)

    def _run_child(
        self, limits: lockdown.Limits, seed: int, descriptor: int, writing: int
    ) -> NoReturn:
        """Become the child, say so on a pipe that student code never has, and serve."""
        try:
            self._become_child(limits, seed, descriptor, writing)
            os.write(writing, _CONFINED)
        except BaseException as error:
            os.write(2, traceback.format_exc().encode())
            os.write(writing, json.dumps(_short_of(error)).encode())
            os._exit(1)
        os.close(writing)
        try:
            serve(socket.socket(fileno=descriptor), self._notebook)
        finally:
            os._exit(1)

    def _become_child(
        self, limits: lockdown.Limits, seed: int, descriptor: int, writing: int
    ) -> None:
        how = self._how
        lockdown.close_other_descriptors(0, 1, 2, descriptor, writing)
        prepare_process(seed)
        lockdown.die_with_parent()
        lockdown.show_memory()
        _be_taken_first(_CHILD_IS_TAKEN)
        os.chdir(self._work / "notebooks")
        sys.path.insert(0, "")
        ruleset = (
            landlock.Ruleset(
                readable=[*how.readable, "/dev/urandom", "/dev/random"],
                changeable=[how.scratch, "/dev/null"],
            )
            if how.use_landlock
            else None
        )
        nothing = os.open(os.devnull, os.O_WRONLY)
        lockdown.limit_resources(limits)
        lockdown.confine(ruleset, self._filter)
        os.dup2(nothing, 2)
        os.close(nothing)

    def _reap(self) -> None:
        """Collect ended processes; say so if the child was among them."""
        with suppress(ChildProcessError):
            while True:
                process, status = os.waitpid(-1, os.WNOHANG)
                if process == 0:
                    return
                if process == self._child:
                    self._child = 0
                    self._say({"gone": self._number, "why": _why(status)})

    def _interrupt(self, only_forks: bool) -> None:
        """End what the child forked, so that it goes on, or interrupt what it does itself."""
        if not self._child:
            return
        with suppress(ProcessLookupError, PermissionError):
            if not only_forks:
                os.kill(self._child, signal.SIGALRM)
        for process in descendants(self._child) if only_forks else ():
            with suppress(ProcessLookupError, PermissionError):
                os.kill(process, signal.SIGKILL)

    def _look_at_usage(self) -> None:
        self._own_time.look(self._usage.processes())
        why = self._usage.excess()
        if why:
            self._sweep()
            self._say({"gone": self._number, "why": why})

    def _sweep(self) -> None:
        """End every process that is left and empty the scratch folder."""
        end_all_others(everything=self._how.alone or bool(self._how.identity))
        self._child = 0
        os.chdir("/")
        empty(Path(self._how.scratch))
        for folder in ("notebooks", "responses", "tmp"):
            (self._work / folder).mkdir(parents=True)
        notebooks = Path(self._how.notebooks)
        for entry in sorted(notebooks.iterdir()) if notebooks.is_dir() else ():
            (self._work / "notebooks" / entry.name).symlink_to(entry)
        data = notebooks.parent / "data"
        if data.is_dir():
            (self._work / "data").symlink_to(data)

    def _say(self, message: dict[str, object]) -> None:
        with suppress(OSError):  # the grader has gone; the closed socket ends the loop
            self._control.send(json.dumps(message).encode())


def _be_taken_first(order: int) -> None:
    """Let the kernel end this process before those of a lower order if memory runs out."""
    with suppress(OSError):
        Path("/proc/self/oom_score_adj").write_text(str(order), encoding="ascii")


def _why(status: int) -> str:
    if os.WIFSIGNALED(status):
        number = os.WTERMSIG(status)
        return BY_SIGNAL.get(signal.Signals(number), f"it ended by signal {number}")
    return "it ended its own process"


def _short_of(error: BaseException) -> dict[str, object]:
    """The system's number of an error, and the file or the limit that it is about."""
    if isinstance(error, MemoryError):
        return {"short": errno.ENOMEM, "where": ""}
    number = error.errno if isinstance(error, OSError) else None
    where = error.filename if isinstance(error, OSError) else None
    return {"short": number, "where": str(where or "")[:300]}


def _bring_font_list() -> None:
    """Copy matplotlib's list of fonts, which takes a second to make, to where it looks for it."""
    cache = os.environ.get("AUTOGRADER_FONT_LIST")
    target = Path(os.environ["MPLCONFIGDIR"])
    target.mkdir(parents=True, exist_ok=True)
    for path in Path(cache).glob("fontlist-*.json") if cache else ():
        with suppress(OSError):
            shutil.copy(path, target)


def main() -> None:
    """Obey the control socket whose descriptor is the first argument."""
    gc.disable()  # what is imported stays: looking through it for garbage is for nothing
    Zygote(socket.socket(fileno=int(sys.argv[1]))).serve()


if __name__ == "__main__":
    main()
