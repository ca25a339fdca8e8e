"""Runs a notebook's cells as Jupyter does, shows nobody anything, and evaluates what they left.

This runs where the student's code runs: nothing in it is trusted once a cell has run.
"""

from __future__ import annotations

import json
import math
import os
import sys
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

# By these names student code cannot put anything in their place.
from random import getstate, setstate

import numpy as np

from autograder.exchange.messages import Message, Value
from autograder.sandbox.inside.cell_time_limit import Interrupted, own_clock
from autograder.sandbox.inside.evaluate import describe, evaluate
from autograder.sandbox.inside.exceptions import after_import, tell
from autograder.sandbox.inside.plain_data import is_plain
from autograder.sandbox.inside.quiet_shell import close_figures, quiet_shell, save_nothing

MAX_SAVED = 2**20
_DESCRIBE_SECONDS = 2.0
_PLAIN = (bool, complex, float, int, str, type(None), type(...), np.float64, np.int64)


class Notebook:
    """One notebook's namespace in an IPython shell; make only one in a process."""

    def __init__(self) -> None:
        import matplotlib
        from matplotlib.figure import Figure

        matplotlib.use("agg")
        # Figures are made, never drawn: nobody looks at them.
        Figure.savefig = save_nothing  # type: ignore[method-assign,assignment]
        self.patience = 1.0  # times a limit: how long on the clock, if somebody outside looks too
        self._shell = quiet_shell()
        self._names_at_start = frozenset(self._shell.user_ns)
        self._chance = getstate()

    def run(
        self,
        cells: list[str],
        names: list[str],
        *,
        skip: dict[str, str] | None = None,
        cell_seconds: float = math.inf,
        seconds: float = math.inf,
        begin: Callable[[int], None] = lambda index: None,
    ) -> dict[str, object]:
        """Run the cells one after the other, like "run all" that does not stop at an error.

        ``skip`` gives the error to report for cells (by index, as text) that are not to be run;
        ``begin`` is called before each cell. A cell that takes too long is interrupted, and the
        cells after ``seconds`` are not run; both are reported as ``timeout``.
        """
        end = own_clock() + seconds
        errors: list[str | None] = []
        told: list[Message | None] = []
        for index, cell in enumerate(cells):
            reason = (skip or {}).get(str(index))
            said = None
            left = end - own_clock()
            if reason is None and left <= 0:
                reason = "timeout"
            if reason is None:
                begin(index)
                reason, said = self._run_cell(cell, min(cell_seconds, left))
            errors.append(reason)
            told.append(said)
        self._chance = getstate()
        namespace = self._shell.user_ns
        return {
            "errors": errors,
            "told": told,
            "responses": _recorded_responses(),
            "understood": {
                name: _described(namespace[name]) for name in names if name in namespace
            },
        }

    def evaluate(self, name: str, probe: Message) -> Message:
        """Turn the response held by a name into plain data, as `evaluate` says."""
        # Python seeds `random` anew in each fork; the same response must earn the same mark again.
        setstate(self._chance)
        if name not in self._shell.user_ns:
            return {"state": "unusable", "reason": "missing"}
        return evaluate(self._shell.user_ns[name], probe)

    def holds_plain_value(self, name: str) -> bool:
        """Whether evaluating the response runs no code of the student.

        Then it is a built-in number, or an expression that sympy made.
        """
        value = self._shell.user_ns.get(name)
        return type(value) in _PLAIN or ("sympy" in sys.modules and is_plain(value))

    def evaluate_within(self, seconds: float, name: str, probe: dict[str, object]) -> Value:
        """As `evaluate`, interrupted after some seconds.

        Raises:
            CellTimeout: if it takes longer.
        """
        with Interrupted(seconds, self.patience):
            return self.evaluate(name, probe)

    def forget(self) -> None:
        """Remove what cells have defined."""
        for name in set(self._shell.user_ns) - self._names_at_start:
            del self._shell.user_ns[name]

    def _run_cell(self, cell: str, seconds: float) -> tuple[str | None, Message | None]:
        """Run one cell; the class of its error and what to tell of it, or None.

        A module that is missing here may be there where the cell was written: what comes after its
        import is run all the same.
        """
        watch = Interrupted(seconds, self.patience)
        first: BaseException | None = None
        try:
            with watch:
                error = self._error_of(cell)
                while error is not None:
                    first = first or error
                    rest = after_import(self._shell.transform_cell(cell), error)
                    if rest is None:
                        break
                    cell = rest
                    error = self._error_of(rest)
                if error is not None and not isinstance(error, ModuleNotFoundError):
                    first = error
        except BaseException as escaped:
            first = escaped
        close_figures()
        if first is None:
            return None, None
        # Python may turn the interruption into another error, as in the middle of a fork.
        if watch.fired:
            return "timeout", None
        with suppress(Exception):
            return type(first).__name__, tell(first)
        return type(first).__name__, None

    def _error_of(self, cell: str) -> BaseException | None:
        result = self._shell.run_cell(cell, store_history=False)
        error: BaseException | None = result.error_before_exec or result.error_in_exec
        return error


def _described(response: object) -> str:
    """What a response was understood as; a text that takes for ever is cut short."""
    try:
        with Interrupted(_DESCRIBE_SECONDS, 10.0):
            return describe(response)
    except BaseException:
        return f"a {type(response).__name__}"


def _recorded_responses() -> Message:
    """What ``ask(...).respond(...)`` in the cells wrote."""
    responses: dict[str, object] = {}
    for path in sorted(Path(os.environ["AUTOGRADER_RESPONSES"]).glob("*.json"))[:100]:
        try:
            if path.stat().st_size <= MAX_SAVED:
                entries = json.loads(path.read_text(encoding="utf-8"))["responses"]
                responses |= {id: entry["response"] for id, entry in entries.items()}
        except (ValueError, KeyError, TypeError, OSError, AttributeError, RecursionError):
            continue
    return responses
