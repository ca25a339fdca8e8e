"""Which kinds of isolation work here: each is tried with real attempts to get out."""

from __future__ import annotations

import atexit
import time
from dataclasses import dataclass, field
from pathlib import Path
from threading import Lock

from autograder.course import Course
from autograder.errors import MachineError, machine_error
from autograder.exchange.channel import Late
from autograder.exchange.wire import WireError
from autograder.sandbox import bubblewrap, landlock, seccomp
from autograder.sandbox.attempts_to_get_out import TRIALS, try_to_get_out
from autograder.sandbox.host import Host
from autograder.sandbox.machine_allows import require_room
from autograder.sandbox.no_isolation_works import SandboxError
from autograder.sandbox.zygote_start import HostError


@dataclass
class Tier:
    """One kind of isolation; ``text`` names it for reports, ``results`` says what was tried."""

    name: str
    with_namespaces: bool
    course: Course
    text: str = ""
    results: dict[str, bool] = field(default_factory=dict)
    problem: str = ""
    seconds: float = 0.0  # how long the trial took, most of it starting
    _started: list[Host] = field(default_factory=list)

    def start(self) -> Host:
        """A new host of this kind.

        Raises:
            HostError: if it cannot be started.
            MachineError: if this machine is short of something.
        """
        return Host(self.course.root, self.course.settings, self.with_namespaces)

    def take_started(self) -> Host | None:
        """A host that was started for the trial and has no use yet."""
        return self._started.pop() if self._started else None

    def try_out(self) -> bool:
        """Start a host and let student code try to get out of it.

        Raises:
            MachineError: if this machine is short of something; a weaker kind is no way out.
        """
        began = time.monotonic()
        self.problem, self.results = "", {}
        try:
            self._started.append(self.start())
            self.results = try_to_get_out(self._started[-1], self.course)
        except (HostError, OSError, EOFError, Late, WireError, MachineError) as error:
            short = machine_error(error)
            if short is not None:
                self.stop_unused()
                raise short from None
            self.problem = str(error) or "the trial did not end"
        failed = [TRIALS[name][1] for name, held in self.results.items() if not held]
        if failed:
            self.problem = "it does not hold that " + " and that ".join(failed)
        if self.problem:
            self.stop_unused()
            return False
        self.text = describe(self.with_namespaces, self._started[-1].has_control_group)
        self.seconds = time.monotonic() - began
        return True

    def stop_unused(self) -> None:
        """End the hosts that nobody has taken."""
        while self._started:
            self._started.pop().stop()


_PARTS = {
    "bubblewrap": "a file system and a list of processes of its own",
    "Landlock": "Landlock",
    "seccomp": "seccomp",
}


def parts(with_namespaces: bool) -> tuple[str, ...]:
    """What keeps student code in on this machine, part by part."""
    works = (with_namespaces, landlock.version() > 0, seccomp.build_filter() is not None)
    return tuple(part for part, here in zip(_PARTS, works, strict=True) if here)


def describe(with_namespaces: bool, has_control_group: bool) -> str:
    """What keeps student code in, and what is missing."""
    there = list(parts(with_namespaces))
    missing = [lost for part, lost in _PARTS.items() if part not in there]
    there.append("process limits")
    if has_control_group:
        there.append("a control group")
    text = f"{', '.join(there[:-1])} and {there[-1]}"
    return text + (f"; missing: {' and '.join(missing)}" if missing else "")


def tiers(course: Course) -> list[Tier]:
    """Every kind of isolation, the best first, not yet tried."""
    return [
        Tier("bubblewrap", True, course),
        Tier("reduced", False, course),
    ]


_best: dict[tuple[Path, str], Tier] = {}
_lock = Lock()


def best_tier(course: Course, wanted: str = "auto") -> Tier:
    """The best kind that works here, or the one that is wanted; tried once a process and course.

    Raises:
        SandboxError: if none works; the sentence says why and what to do.
        MachineError: if this machine allows less than a notebook may use.
    """
    require_room(course.settings)
    with _lock:
        tried = _best.get((course.root, wanted))
        if tried is not None:
            return tried
        problems = []
        for tier in tiers(course):
            if wanted not in ("auto", tier.name):
                continue
            # What did not come to an end says nothing of the isolation: this machine may have stood
            # still meanwhile, and a weaker kind for that would be for the whole run.
            if tier.try_out() or (not tier.results and tier.try_out()):
                atexit.register(tier.stop_unused)
                _best[course.root, wanted] = tier
                return tier
            problems.append(f"{tier.name}: {tier.problem.rstrip('.')}")
    raise SandboxError(
        f"Submissions cannot be isolated on this machine ({'; '.join(problems)}). "
        f"{advice()} `autograder doctor` shows each attempt; --no-sandbox grades with your own "
        "rights, only for submissions that you trust."
    )


def advice() -> str:
    """What to change on this machine so that bubblewrap works."""
    if bubblewrap.find_bubblewrap() is None:
        return "Install bubblewrap (apt install bubblewrap)."
    return (
        "Allow user namespaces (on Ubuntu: sysctl kernel.apparmor_restrict_unprivileged_userns=0; "
        "in a container: --security-opt seccomp=unconfined)."
    )
