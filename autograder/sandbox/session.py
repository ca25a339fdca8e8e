"""One notebook of one submission in a sandbox, asked from the trusted side."""

from __future__ import annotations

import math
import re
import signal
import time
from collections.abc import Callable

from autograder.course import Settings
from autograder.exchange.messages import Evaluation, Message, Report
from autograder.exchange.replies import clean_evaluation, clean_report
from autograder.language import N_
from autograder.sandbox.conversation import GRACE, Conversation
from autograder.sandbox.host import Host
from autograder.sandbox.machine_to_blame import Doubt
from autograder.sandbox.stop_errors import Stopped, out_of_time, stop_by
from autograder.sandbox.zygote_start import HostError

PATIENCE = 20  # times a limit: how long to wait for a child that is given no processor
MAX_RESTARTS = 3


class Session:
    """Runs one notebook and evaluates what it left.

    When a cell hangs or crashes beyond what the child itself can catch, the notebook is run again
    without that cell; when a response does, the next question still works. After ``deadline``, on
    the monotonic clock, nothing is begun any more.
    """

    def __init__(
        self,
        take_host: Callable[[], Host],
        settings: Settings,
        seed: int,
        deadline: float = math.inf,
        doubt: Doubt | None = None,
    ) -> None:
        self._take_host = take_host
        self._doubt = Doubt() if doubt is None else doubt
        self._deadline = deadline
        self._settings = settings
        self._seed = seed
        self._conversation: Conversation | None = None
        self._cells: list[str] = []
        self._stopped_cells: dict[int, Stopped] = {}
        self._restarts_left = MAX_RESTARTS
        self._begun_anew = False

    def __enter__(self) -> Session:
        return self

    def __exit__(self, *exception: object) -> None:
        self._close()

    def run(self, cells: list[str], names: list[str]) -> Report:
        """Run the cells; ``names`` are the variables whose understood value is wanted.

        The report has ``errors`` (for each cell the class of its exception, ``timeout``, ``killed``
        or None), ``responses`` (what ``ask(...).respond(...)`` recorded, by question) and
        ``understood`` (a short text for each name).

        Raises:
            Stopped: if no run of the notebook came to its end.
        """
        self._cells, self._stopped_cells, self._begun_anew = cells, {}, False
        self._check_deadline()
        return self._run(names)

    def evaluate(self, name: str, probe: Message) -> Evaluation:
        """Evaluate the response held by ``name``, as `autograder.sandbox.inside.evaluate` says.

        Raises:
            Stopped: if it takes too long, if its process dies, or if the cell that should define it
                was stopped.
        """
        self._check_deadline()
        if self._conversation is None or not self._conversation.is_open:
            self._restart()
            self._run([])
        try:
            reply = self._reply_to(name, probe)
        except Stopped:
            if not self._may_begin_anew(name):
                raise
            # What an interrupted cell left running, such as a fork bomb, may have taken the time or
            # the memory of the cells after it and of the evaluation: begin anew without it, once.
            self._begun_anew = True
            first = min(self._stopped_cells)
            self._stopped_cells = {first: self._stopped_cells[first]}
            self._close()
            self._restart()
            self._run([])
            reply = self._reply_to(name, probe)
        return reply

    def _may_begin_anew(self, name: str) -> bool:
        """Whether another cell than the one that should define ``name`` may be to blame."""
        if self._begun_anew or not self._stopped_cells or self._restarts_left == 0:
            return False
        return not _mentions(self._cells[min(self._stopped_cells)], name)

    def _reply_to(self, name: str, probe: Message) -> Evaluation:
        reply = clean_evaluation(self._ask_to_evaluate(name, probe)["reply"])
        if reply.get("reason") == "missing":
            for index, stop in self._stopped_cells.items():
                if _mentions(self._cells[index], name):
                    raise Stopped(stop.status, stop.why)
        return reply

    def _ask_to_evaluate(self, name: str, probe: dict[str, object]) -> dict[str, object]:
        seconds = min(self._settings.question_seconds, self._deadline - time.monotonic())
        if seconds <= 0:  # running the notebook again took the rest
            raise self._out_of_time()
        message = {
            "do": "evaluate",
            "name": name,
            "probe": probe,
            "seconds": seconds,
            "most": int(self._settings.output_mb * 2**20),
        }
        talk = self._open_conversation()
        answer = talk.ask(message, seconds, time.monotonic() + seconds * PATIENCE + GRACE)
        if "reply" not in answer and talk.was_interrupted:
            raise Stopped("timeout")
        if "reply" not in answer:
            # The kernel, or the alarm that rings when a limit has passed many times over.
            ended_by = answer.get("ended_by")  # whatever a student's process says
            if isinstance(ended_by, int) and ended_by in (signal.SIGKILL, signal.SIGALRM):
                self._doubt.is_unexplained = True
            raise stop_by(answer.get("ended_by"))
        return answer

    def _run(self, names: list[str]) -> Report:
        settings = self._settings
        end = min(time.monotonic() + settings.notebook_seconds * PATIENCE, self._deadline)
        began, had_before = time.monotonic(), self._doubt.own_seconds
        while True:
            talk = self._open_conversation()
            # What processes that had to be stopped have had is not given again; what they waited
            # for a processor is no loss.
            had = self._doubt.own_seconds - had_before
            left = max(GRACE, settings.notebook_seconds - had)
            message = {
                "do": "run",
                "cells": self._cells,
                "names": names,
                "skip": {str(index): stop.status for index, stop in self._stopped_cells.items()},
                "cell_seconds": settings.cell_seconds,
                "seconds": min(left, end - time.monotonic()),
            }
            try:
                answer = talk.ask(message, left + GRACE / 2, end + GRACE, len(self._cells))
            except Stopped as stopped:
                index = talk.in_cell
                if index is None or index in self._stopped_cells or time.monotonic() >= end:
                    raise
                self._stopped_cells[index] = stopped
                self._restart()
                continue
            report = clean_report(answer.get("reply"), len(self._cells))
            if "timeout" in report["errors"]:
                # All cells together had no time enough for one of them to have used its own up?
                self._doubt.look(talk.own_time(began), settings.cell_seconds)
            for index, error in enumerate(report["errors"]):
                if error == "timeout":
                    self._stopped_cells.setdefault(index, Stopped("timeout"))
            return report

    def _check_deadline(self) -> None:
        if time.monotonic() >= self._deadline:
            raise self._out_of_time()

    def _out_of_time(self) -> Stopped:
        self._doubt.ran_out = True
        return out_of_time()

    def _restart(self) -> None:
        """Begin anew after a failure, a limited number of times.

        Raises:
            Stopped: if it was tried too often.
        """
        if self._restarts_left == 0:
            raise Stopped("killed", N_("the notebook had to be stopped too often"))
        self._restarts_left -= 1
        self._open()

    def _open_conversation(self) -> Conversation:
        """The conversation that is open, or a new one."""
        if self._conversation is not None and self._conversation.is_open:
            return self._conversation
        return self._open()

    def _open(self) -> Conversation:
        host = self._take_host()
        try:
            self._conversation = Conversation(host, self._settings, self._seed, self._doubt)
        except HostError:
            host.stop()
            host = self._take_host()  # a new one
            try:
                self._conversation = Conversation(host, self._settings, self._seed, self._doubt)
            except HostError:
                host.stop()
                raise
        return self._conversation

    def _close(self) -> None:
        if self._conversation is not None:
            self._conversation.close()
            self._conversation = None


def _mentions(cell: str, name: str) -> bool:
    return re.search(rf"\b{re.escape(name)}\b", cell) is not None
