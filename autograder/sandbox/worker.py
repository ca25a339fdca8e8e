"""The process in which student code runs: ``python -m autograder.sandbox.worker``.

It obeys two messages on standard input and answers each on standard output:

- ``{"do": "run", "cells": [code, ...], "names": [...]}`` runs the cells of a notebook one after the
  other, like Jupyter's "run all" that does not stop at an error. Answer: ``{"errors": [class or
  None, ...], "responses": {id: response}, "understood": {name: text}}``.
- ``{"do": "evaluate", "name": ..., "probe": ...}`` evaluates one response of the final namespace.
  Answer: as `autograder.sandbox.evaluate` says.

The key is not here: whatever student code does to this process, it can only spoil its own marks.
"""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import Any, BinaryIO

from autograder.sandbox import wire
from autograder.sandbox.evaluate import describe, evaluate


def main() -> None:
    """Serve until standard input closes."""
    requests, replies = _take_the_channel()
    _forget_the_solutions()
    _limit_memory(int(os.environ.get("AUTOGRADER_MEMORY_MB", "0")))
    notebook = Notebook()

    def read_exactly(count: int) -> bytes:
        data = requests.read(count)
        if len(data) < count:
            raise EOFError
        return data

    while True:
        try:
            message = wire.read_message(read_exactly)
        except EOFError:
            return
        reply = notebook.obey(message)
        replies.write(wire.encode(reply))
        replies.flush()


class Notebook:
    """One notebook's namespace."""

    def __init__(self) -> None:
        import matplotlib

        matplotlib.use("agg")
        self.shell = _quiet_shell()

    def obey(self, message: dict[str, Any]) -> dict[str, Any]:
        if message["do"] == "run":
            return self.run(message["cells"], message["names"])
        return self.evaluate(message["name"], message["probe"])

    def run(self, cells: list[str], names: list[str]) -> dict[str, Any]:
        errors = []
        for cell in cells:
            result = self.shell.run_cell(cell, store_history=False)
            error = result.error_before_exec or result.error_in_exec
            errors.append(type(error).__name__ if error is not None else None)
        namespace = self.shell.user_ns
        return {
            "errors": errors,
            "responses": _recorded_responses(),
            "understood": {name: describe(namespace[name]) for name in names if name in namespace},
        }

    def evaluate(self, name: str, probe: dict[str, Any]) -> dict[str, Any]:
        if name not in self.shell.user_ns:
            return {"state": "unusable", "reason": "missing"}
        return evaluate(self.shell.user_ns[name], probe)


def _quiet_shell() -> Any:
    """IPython as Jupyter's kernel has it, magics and all, but nobody is shown anything."""
    from IPython.core.displayhook import DisplayHook
    from IPython.core.displaypub import DisplayPublisher
    from IPython.core.interactiveshell import InteractiveShell

    class NoResults(DisplayHook):
        def __call__(self, result: Any = None) -> None:
            """Drop the value of a cell's last line."""

    class NoOutputs(DisplayPublisher):
        def publish(self, *args: Any, **kwargs: Any) -> None:
            """Drop what display() shows."""

    class QuietShell(InteractiveShell):
        def showtraceback(self, *args: Any, **kwargs: Any) -> None:
            """Formatting a traceback costs more than most cells."""

        showsyntaxerror = showtraceback
        showindentationerror = showtraceback

    return QuietShell.instance(displayhook_class=NoResults, display_pub_class=NoOutputs)


def _recorded_responses() -> dict[str, Any]:
    """What ``ask(...).respond(...)`` in the cells wrote."""
    responses: dict[str, Any] = {}
    for path in Path(os.environ["AUTOGRADER_RESPONSES"]).glob("*.json"):
        try:
            entries = json.loads(path.read_text(encoding="utf-8"))["responses"]
            responses |= {id: entry["response"] for id, entry in entries.items()}
        except (ValueError, KeyError, TypeError, OSError):
            continue
    return responses


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

    import cv2  # noqa: F401  -- what a notebook imports anyway is not charged to the student
    import matplotlib.pyplot  # noqa: F401
    import numpy  # noqa: F401
    import sympy  # noqa: F401

    try:
        used = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    except OSError:
        return
    limit = used + megabytes * 2**20
    resource.setrlimit(resource.RLIMIT_AS, (limit, limit))


if __name__ == "__main__":
    main()
