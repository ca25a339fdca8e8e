"""The workers of a cluster as the coordinator knows them: ready, preparing, or refused."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from distributed import Client

from autograder.grading.dask_connection import ClusterError
from autograder.grading.dask_worker import proof

FIRST_WORKER_SECONDS = 120.0
ALONE_SECONDS = 300.0  # how long a run waits for a worker after the last has left
REFUSED_SECONDS = 20.0  # the same, if those that are there were refused
_LOOK_SECONDS = 2.0
_MOST_NAMED = 20


@dataclass(frozen=True)
class Member:
    """One worker: its ``state``, why it was refused, how it isolates, where it runs, its slots."""

    state: str
    reason: str = ""
    isolation: str = ""
    where: str = ""
    slots: int = 0


class Crew:
    """Keeps track of the workers; ``tell`` is given a sentence for each that is refused."""

    def __init__(self, client: Client, plugin: str, tell: Callable[[str], None]) -> None:
        self._client, self._plugin, self._tell = client, plugin, tell
        self._members: dict[str, Member] = {}
        self._told: set[tuple[str, str]] = set()
        self._worked: dict[str, set[str]] = {}  # isolation: who has it, also those that left
        self._next_look = 0.0
        self._last_ready = time.monotonic()

    @property
    def slots(self) -> int:
        """How many submissions can be at work at once."""
        return sum(member.slots for member in self._members.values() if member.state == "ready")

    @property
    def isolation(self) -> str:
        """What keeps student code in on the workers; if kinds differ, with those that have them."""
        if len(self._worked) == 1:
            return next(iter(self._worked))
        return "; ".join(f"{text} ({_named(who)})" for text, who in sorted(self._worked.items()))

    def describe(self) -> str:
        """How many there are, in words."""
        ready = sum(member.state == "ready" for member in self._members.values())
        refused = sum(member.state == "refused" for member in self._members.values())
        said = "1 worker" if ready == 1 else f"{ready} workers"
        return f"{said}, {refused} refused" if refused else said

    def wait_for_first(self) -> None:
        """Wait until a worker is ready.

        Raises:
            ClusterError: if none comes, or all are refused.
        """
        deadline = time.monotonic() + FIRST_WORKER_SECONDS
        while True:
            self.look_after(at_once=True)
            states = [member.state for member in self._members.values()]
            if "ready" in states:
                return
            if states and set(states) == {"refused"}:
                raise ClusterError(f"No worker can be used. {self._reasons()}")
            if time.monotonic() > deadline:
                raise ClusterError(
                    "The scheduler has no workers; start some with `dask worker ADDRESS`."
                    if not states
                    else "The workers do not get ready; look at what they print."
                )
            time.sleep(0.1)

    def has_unable(self) -> bool:
        """Whether a worker cannot load this autograder at all."""
        answers = self._client.run(proof, self._plugin, on_error="return")
        return any(_member(answer).state == "refused" for answer in answers.values())

    def look_after(self, at_once: bool = False) -> None:
        """See who has come and gone, now and then.

        Raises:
            ClusterError: if nobody is left, and nobody has come for some time.
        """
        now = time.monotonic()
        if now < self._next_look and not at_once:
            return
        self._next_look = now + _LOOK_SECONDS
        there = self._client.nthreads()
        self._members = {address: self._members.get(address, Member("new")) for address in there}
        unsure = [a for a, member in self._members.items() if member.state in ("new", "preparing")]
        if unsure:
            answers = self._client.run(proof, self._plugin, workers=unsure, on_error="return")
            for address, answer in answers.items():
                self._members[address] = _member(answer)
        self._note()
        if self.slots:
            self._last_ready = now
        states = {member.state for member in self._members.values()}
        patience = REFUSED_SECONDS if states == {"refused"} else ALONE_SECONDS
        if not at_once and now - self._last_ready > patience:
            raise ClusterError(
                f"No worker is left. {self._reasons()}What was graded is kept; start workers and "
                "run this command again to go on."
            )

    def ask_again(self) -> None:
        """Ask everybody anew at the next look: one of them has withdrawn."""
        for address, member in self._members.items():
            if member.state == "ready":
                self._members[address] = Member("new", where=member.where)
        self._next_look = 0.0

    def _note(self) -> None:
        for address, member in self._members.items():
            name = f"{address} ({member.where})" if member.where else address
            if member.state == "ready":
                self._worked.setdefault(member.isolation, set()).add(address)
            elif member.state == "refused" and (address, member.reason) not in self._told:
                self._told.add((address, member.reason))
                self._tell(f"Worker {name} is refused: {member.reason.rstrip('.')}.")

    def _reasons(self) -> str:
        reasons = [
            f"{address}: {member.reason.rstrip('.')}. "
            for address, member in self._members.items()
            if member.state == "refused"
        ]
        more = f"{len(reasons) - 3} more are refused. " if len(reasons) > 3 else ""
        return "".join(reasons[:3]) + more


def _member(answer: Any) -> Member:
    if isinstance(answer, dict):
        return Member(**answer)
    if isinstance(answer, OSError):  # it has just gone, or cannot be reached now
        return Member("new")
    return Member(
        "refused", f"it cannot load this autograder ({type(answer).__name__}); install it there"
    )


def _named(who: set[str]) -> str:
    names = sorted(who)[:_MOST_NAMED]
    count = "1 worker" if len(who) == 1 else f"{len(who)} workers"
    return f"{count}: {', '.join(names)}{', …' if len(who) > _MOST_NAMED else ''}"
