"""The child of the zygote in which one notebook of one submission runs.

It obeys the messages of one channel until that closes:

- ``{"do": "run", "nonce", "cells", "names", "skip", "cell_seconds", "seconds"}`` runs a notebook.
  Before each cell ``{"nonce", "cell": index}`` goes back, at the end ``{"nonce", "reply": ...}``.
- ``{"do": "evaluate", "nonce", "name", "probe", "seconds", "most"}`` evaluates one response in a
  fork, so that a crash or a hang costs one question and no question changes the variables that the
  next one sees. ``{"nonce", "reply": ...}`` or, if the fork ended without one, ``{"nonce",
  "ended_by": signal}`` goes back; a reply of more than ``most`` bytes is not sent. Files and
  processes that a response leaves stay until the notebook ends: this process is the student's too
  and may end none.

The nonce ties an answer to its question: what student code may have written into the channel before
is passed over by the grader.
"""

from __future__ import annotations

import gc
import os
import signal
import socket
import sys
from contextlib import suppress
from typing import NoReturn

from autograder.exchange import wire
from autograder.exchange.channel import Channel
from autograder.exchange.messages import Message
from autograder.sandbox.inside.cell_time_limit import CellTimeout
from autograder.sandbox.inside.notebook import Notebook

PATIENCE = 20  # times a limit: how long to wait on a machine that has other things to do
_ANSWERED = 77  # exit status of a fork that has sent its answer


def serve(sock: socket.socket, notebook: Notebook) -> NoReturn:
    """Obey until the channel closes, then end the process."""
    channel = Channel(sock)
    notebook.patience = PATIENCE
    try:
        while True:
            message = channel.receive()
            if message["do"] == "run":
                _run(channel, notebook, message)
            else:
                _evaluate(channel, notebook, message)
    except BaseException:
        # The grader has gone, or student code has broken this process: both end it.
        os._exit(0)


def seed_everything(seed: int) -> None:
    """Make chance repeat itself, as far as it comes from the libraries' own generators."""
    import random

    import numpy as np

    random.seed(seed)
    np.random.seed(seed % 2**32)
    if "cv2" in sys.modules:  # loaded while warming up, if the course has it
        sys.modules["cv2"].setRNGSeed(seed % 2**31)
    # default_rng() without a seed asks the system for one, through this function.
    repeatable = random.Random(seed)
    with suppress(AttributeError):
        np.random.bit_generator.randbits = repeatable.getrandbits  # type: ignore[attr-defined]


def _run(channel: Channel, notebook: Notebook, message: Message) -> None:
    nonce = message["nonce"]
    reply = notebook.run(
        message["cells"],
        message["names"],
        skip=message["skip"],
        cell_seconds=message["cell_seconds"],
        seconds=message["seconds"],
        begin=lambda index: channel.send({"nonce": nonce, "cell": index}),
    )
    _answer(channel, nonce, reply)


def _evaluate(channel: Channel, notebook: Notebook, message: Message) -> None:
    nonce = message["nonce"]
    if notebook.holds_plain_value(message["name"]):
        # No code of the student runs, so that a fork, which costs more than all the rest, is not
        # needed. Should even this hang or crash, the grader runs the notebook again.
        try:
            reply = notebook.evaluate_within(message["seconds"], message["name"], message["probe"])
        except CellTimeout:
            channel.send({"nonce": nonce, "ended_by": signal.SIGALRM})
        else:
            _answer(channel, nonce, reply, message.get("most"))
        return
    _reap_leftovers()
    child = os.fork()
    if child == 0:
        try:
            # Not a Python handler: the kernel ends the process even inside a C function.
            signal.signal(signal.SIGPROF, signal.SIG_DFL)
            signal.signal(signal.SIGALRM, signal.SIG_DFL)
            signal.setitimer(signal.ITIMER_PROF, message["seconds"])
            # Whoever sleeps is ended from outside, where it can be told from waiting for a turn.
            signal.setitimer(signal.ITIMER_REAL, message["seconds"] * PATIENCE)
            reply = notebook.evaluate(message["name"], message["probe"])
            signal.setitimer(signal.ITIMER_PROF, 0)
            signal.setitimer(signal.ITIMER_REAL, 0)
            _answer(channel, nonce, reply, message.get("most"))
            os._exit(_ANSWERED)
        finally:
            os._exit(1)
    _, status = os.waitpid(child, 0)
    if os.waitstatus_to_exitcode(status) != _ANSWERED:
        ended_by = os.WTERMSIG(status) if os.WIFSIGNALED(status) else 0
        channel.send({"nonce": nonce, "ended_by": ended_by})


def _reap_leftovers() -> None:
    """Give the places of ended processes back, which a cell forked and never waited for."""
    with suppress(ChildProcessError):
        while os.waitpid(-1, os.WNOHANG)[0]:
            pass


def _answer(
    channel: Channel, nonce: str, reply: dict[str, object], most: int | None = None
) -> None:
    try:
        channel.send({"nonce": nonce, "reply": reply}, most=most)
    except wire.TooLarge:
        channel.send({"nonce": nonce, "reply": {"state": "unusable", "reason": "too large"}})
    except wire.WireError:
        channel.send({"nonce": nonce, "reply": {"state": "unusable", "reason": "not plain"}})


def prepare_process(seed: int) -> None:
    """Give a fork what it must not share: a session, signal handlers, chance, its garbage."""
    os.setsid()
    signal.set_wakeup_fd(-1)
    for number in (signal.SIGCHLD, signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_DFL)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    seed_everything(seed)
    gc.enable()
