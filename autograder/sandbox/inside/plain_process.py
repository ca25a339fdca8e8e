"""A plain process for student code, for ``--no-sandbox``.

It is started by ``python -m autograder.sandbox.inside.plain_process``.

It obeys two messages on standard input and answers each on standard output:

- ``{"do": "run", "cells": [code, ...], "names": [...]}`` runs the cells of a notebook one after the
  other. Answer: ``{"errors": [class or None, ...], "responses": {id: response}, "understood":
  {name: text}}``.
- ``{"do": "evaluate", "name": ..., "probe": ...}`` evaluates one response of the final namespace.
  Answer: as `autograder.sandbox.inside.evaluate` says.

The key is not here: whatever student code does to this process, it can only spoil its own marks.
But it runs with the instructor's rights: it can read what the instructor can.
"""

from __future__ import annotations

import importlib
import os
import sys
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO

from autograder.exchange import wire
from autograder.sandbox.inside.notebook import Notebook


def main() -> None:
    """Serve until standard input closes."""
    requests, replies = _take_the_channel()
    _forget_the_solutions()
    _limit_memory(int(os.environ.get("AUTOGRADER_MEMORY_MB", "0")))
    notebook = Notebook()

    while True:
        try:
            message = wire.read_stream(requests)
        except EOFError:
            return
        if message["do"] == "run":
            seconds = message["cell_seconds"], message["seconds"]
            reply = notebook.run(
                message["cells"], message["names"], cell_seconds=seconds[0], seconds=seconds[1]
            )
        else:
            reply = notebook.evaluate(message["name"], message["probe"])
        replies.write(wire.encode(reply))
        replies.flush()


def _take_the_channel() -> tuple[BinaryIO, BinaryIO]:
    """Move the channel away from standard input and output, where student code reads and prints."""
    requests = os.fdopen(os.dup(0), "rb")
    replies = os.fdopen(os.dup(1), "wb")
    nothing = os.open(os.devnull, os.O_RDWR)
    for descriptor in (0, 1, 2):
        os.dup2(nothing, descriptor)
    return requests, replies


def _forget_the_solutions() -> None:
    """Take the course's own folder, which an editable install adds, off the import path."""
    sys.path[:] = [
        entry for entry in sys.path if not (Path(entry or ".") / "solutions" / "answers").is_dir()
    ]


def _limit_memory(megabytes: int) -> None:
    if not megabytes or sys.platform == "win32":
        return
    import resource

    # What a notebook imports anyway is not charged to the student; not every course has all.
    for name in ("cv2", "matplotlib.pyplot", "numpy", "sympy"):
        with suppress(ImportError):
            importlib.import_module(name)

    try:
        used = int(Path("/proc/self/statm").read_bytes().split()[0]) * resource.getpagesize()
    except OSError:
        return
    limit = used + megabytes * 2**20
    resource.setrlimit(resource.RLIMIT_AS, (limit, limit))


if __name__ == "__main__":
    main()
