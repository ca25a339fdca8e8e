"""The workers of a cluster as the coordinator knows them: ready, preparing, or refused."""

from __future__ import annotations

import time
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass

import dask.config
from dask.utils import parse_timedelta
from distributed import Client

from autograder.grading.dask_connection import ClusterError
from autograder.grading.dask_requirements import Wanted
from autograder.grading.dask_worker import prepare, proof, rest

FIRST_WORKER_SECONDS = 120.0
ALONE_SECONDS = 300.0  # how long a run waits for a worker after the last has left
REFUSED_SECONDS = 20.0  # the same, also at the start, if those that are there were refused
_LOOK_SECONDS = 2.0
_NEWCOMER_SECONDS = 0.3
_REST_SECONDS = 5.0
_MOST_NAMED = 20


@dataclass(frozen=True)
class Member:
    """One worker: its ``state``, why it was refused, how it isolates, its host and its slots."""

    state: str
    reason: str = ""
    isolation: str = ""
    host: str = ""
    slots: int = 0


class Crew:
    """Keeps track of the workers; ``tell`` is given a sentence for each that is refused."""

    def __init__(self, client: Client, wanted: Wanted, tell: Callable[[str], None]) -> None:
        self._client, self._wanted, self._tell = client, wanted, tell
        self._members: dict[str, Member] = {}
        self._names: dict[str, str] = {}
        self._told: set[tuple[str, str]] = set()
        self._worked: dict[str, set[str]] = {}  # isolation: who has it, also those that left
        self._next_look = 0.0
        self._last_ready = time.monotonic()
        self._started = self._doubtful = False
        self._beside = ThreadPoolExecutor(2, "crew")
        self._look: Future[None] | None = None
        self._look_began = 0.0
        # As long as a scheduler waits for a worker that is silent, if Dask is not told otherwise.
        ttl = dask.config.get("distributed.scheduler.worker-ttl")
        self._patience = parse_timedelta(ttl) if ttl else None

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

        Where all that are there are refused, others may be on their way.

        Raises:
            ClusterError: if none comes, or all are refused.
        """
        deadline = time.monotonic() + FIRST_WORKER_SECONDS
        hopeful = time.monotonic()
        while True:
            self.look_after()
            states = [member.state for member in list(self._members.values())]
            if "ready" in states:
                self._started, self._last_ready = True, time.monotonic()
                return
            if set(states) != {"refused"}:
                hopeful = time.monotonic()
            elif time.monotonic() - hopeful > REFUSED_SECONDS:
                raise ClusterError(f"No worker can be used. {self._reasons()}")
            if time.monotonic() > deadline:
                raise ClusterError(
                    "The scheduler has no workers; start some with `dask worker ADDRESS`."
                    if not states
                    else "The workers did not get ready; look at their output."
                )
            time.sleep(0.05)

    def look_after(self) -> None:
        """See who has come and gone, now and then; have newcomers prepare.

        The look itself goes on beside, since a worker that hangs takes long to answer.

        Raises:
            ClusterError: if nobody is left, and nobody has come for some time.
            TimeoutError: if the scheduler is there and does not answer.
        """
        now = time.monotonic()
        if self._look is None:
            if now >= self._next_look:
                self._look, self._look_began = self._beside.submit(self._see), now
            return
        if not self._look.done():
            # It may wait for a worker that hangs, or for the scheduler.
            if self._patience and now - self._look_began > self._patience:
                self._who_is_there()
                self._look_began = time.monotonic()
            return
        look, self._look = self._look, None
        look.result()
        self._note()
        if self.slots:
            self._last_ready = now
        states = {member.state for member in self._members.values()}
        hurry = not self.slots or "preparing" in states
        self._next_look = now + (_NEWCOMER_SECONDS if hurry else _LOOK_SECONDS)
        patience = REFUSED_SECONDS if states == {"refused"} else ALONE_SECONDS
        if self._started and now - self._last_ready > patience:
            raise ClusterError(
                f"No worker is left. {self._reasons()}What was graded is kept; start workers and "
                "run this command again to go on."
            )

    def rest(self) -> None:
        """Have workers close what is idle: a courtesy, so none is waited for that hangs."""
        asked = self._beside.submit(self._client.run, rest, self._wanted.name)
        with suppress(Exception):
            asked.result(_REST_SECONDS)

    def close(self) -> None:
        """Look no more."""
        self._beside.shutdown(wait=False, cancel_futures=True)

    def _who_is_there(self) -> dict[str, dict[str, object]]:
        identity = self._client.sync(
            self._client.scheduler.identity, n_workers=-1, callback_timeout=self._patience
        )
        there: dict[str, dict[str, object]] = identity["workers"]
        return there

    def _see(self) -> None:
        there = self._who_is_there()
        self._names |= {address: str(worker["name"]) for address, worker in there.items()}
        members = {a: self._members.get(a, Member("new")) for a in there}
        if self._doubtful:
            self._doubtful = False
            members = {
                a: Member("preparing") if member.state == "ready" else member
                for a, member in members.items()
            }
        self._members = members
        self._ask(prepare, self._wanted, "new")
        self._ask(proof, self._wanted.name, "preparing")

    def _ask(self, question: Callable[..., object], argument: object, state: str) -> None:
        """Run a function on every worker that is in a state."""
        addresses = [a for a, member in self._members.items() if member.state == state]
        if addresses:
            answers = self._client.run(question, argument, workers=addresses, on_error="return")
            self._members = {**self._members, **{a: _member(said) for a, said in answers.items()}}

    def ask_again(self) -> None:
        """Ask everybody anew at the next look: one of them has withdrawn."""
        self._doubtful = True
        self._next_look = 0.0

    def _note(self) -> None:
        for address, member in self._members.items():
            if member.state == "ready":
                self._worked.setdefault(member.isolation, set()).add(self._names[address])
            elif member.state == "refused" and (address, member.reason) not in self._told:
                self._told.add((address, member.reason))
                place = f"{address} on {member.host}" if member.host else address
                self._tell(
                    f"Worker {self._names[address]} ({place}) is refused: "
                    f"{member.reason.rstrip('.')}."
                )

    def _reasons(self) -> str:
        reasons = [
            f"{self._names[address]}: {member.reason.rstrip('.')}. "
            for address, member in self._members.items()
            if member.state == "refused"
        ]
        more = f"{len(reasons) - 3} more are refused. " if len(reasons) > 3 else ""
        return "".join(reasons[:3]) + more


def _member(answer: object) -> Member:
    """What a worker's answer says of it; preparing has none."""
    if answer is None:
        return Member("preparing")
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
