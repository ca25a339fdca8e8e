"""Runs a notebook's cells as Jupyter does, shows nobody anything, and evaluates what they left.

This runs where the student's code runs: nothing in it is trusted once a cell has run.
"""

from __future__ import annotations

import base64
import json
import math
import os
import signal
import sys
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

# By these names student code cannot put anything in their place.
from random import getstate, setstate
from typing import Any

import numpy as np

from autograder.exchange.messages import Message, Value
from autograder.sandbox.inside.evaluate import describe, evaluate
from autograder.sandbox.inside.exceptions import after_import, tell
from autograder.sandbox.inside.plain_data import is_plain

MAX_SAVED = 2**20
_DESCRIBE_SECONDS = 2.0
_PLAIN = (bool, complex, float, int, str, type(None), type(...), np.float64, np.int64)
_PIXEL = base64.b64decode(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJg"
    "gg=="
)
_CAN_INTERRUPT = hasattr(signal, "setitimer")


class CellTimeout(KeyboardInterrupt):
    """A cell took longer than it may; like Ctrl-C, `except Exception` does not stop it."""


class Notebook:
    """One notebook's namespace in an IPython shell; make only one in a process."""

    def __init__(self) -> None:
        import matplotlib
        from matplotlib.figure import Figure

        matplotlib.use("agg")
        # Figures are made, never drawn: nobody looks at them.
        Figure.savefig = _save_nothing  # type: ignore[method-assign,assignment]
        self.patience = 1.0  # times a limit: how long on the clock, if somebody outside looks too
        self._shell = _quiet_shell()
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
        end = _own_clock() + seconds
        errors: list[str | None] = []
        told: list[Message | None] = []
        for index, cell in enumerate(cells):
            reason = (skip or {}).get(str(index))
            said = None
            left = end - _own_clock()
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
        with _Interrupted(seconds, self.patience):
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
        watch = _Interrupted(seconds, self.patience)
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
        _close_figures()
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


class _Interrupted:
    """Raises `CellTimeout` in the code inside after some seconds, unless that code prevents it.

    They are seconds of a processor; on the clock it may be ``patience`` times as many.
    """

    def __init__(self, seconds: float, patience: float = 1.0) -> None:
        self._seconds, self._patience = seconds, patience
        self._inside = False
        self.fired = False

    def __enter__(self) -> None:
        if _CAN_INTERRUPT and self._seconds < math.inf:
            self._inside = True
            seconds = max(self._seconds, 0.001)
            signal.signal(signal.SIGPROF, self._interrupt)
            signal.signal(signal.SIGALRM, self._interrupt)
            signal.setitimer(signal.ITIMER_PROF, seconds)
            signal.setitimer(signal.ITIMER_REAL, seconds * self._patience)

    def __exit__(self, *exception: object) -> None:
        if self._inside:
            self._inside = False
            signal.setitimer(signal.ITIMER_PROF, 0)
            signal.setitimer(signal.ITIMER_REAL, 0)

    def _interrupt(self, number: int, frame: object) -> None:
        if not self._inside:  # one that was on its way as the code ended
            return
        self.fired = True
        raise CellTimeout


def _own_clock() -> float:
    """A clock that stands still while this thread waits for a processor, where Linux tells."""
    try:
        waited = int(Path("/proc/thread-self/schedstat").read_text(encoding="utf-8").split()[1])
    except (OSError, IndexError, ValueError):
        waited = 0
    return time.monotonic() - waited / 1e9


def _described(response: object) -> str:
    """What a response was understood as; a text that takes for ever is cut short."""
    try:
        with _Interrupted(_DESCRIBE_SECONDS, 10.0):
            return describe(response)
    except BaseException:
        return f"a {type(response).__name__}"


def _save_nothing(figure: object, target: Any, *arguments: object, **options: object) -> None:
    """Stand in for ``Figure.savefig``: a picture of one pixel."""
    if hasattr(target, "write"):
        target.write(_PIXEL)
    else:
        Path(target).write_bytes(_PIXEL)


def _close_figures() -> None:
    """Forget the figures of a cell, as Jupyter does after it has shown them."""
    helpers = sys.modules.get("matplotlib._pylab_helpers")
    if helpers is not None:
        with suppress(Exception):
            helpers.Gcf.destroy_all()


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


def _quiet_shell() -> Any:
    """IPython as Jupyter's kernel has it, magics and all, without output, history or programs."""
    from IPython.core.displayhook import DisplayHook
    from IPython.core.displaypub import DisplayPublisher
    from IPython.core.interactiveshell import InteractiveShell
    from IPython.core.magics.script import ScriptMagics
    from IPython.utils.text import SList
    from traitlets.config import Config

    class NoResults(DisplayHook):
        def __call__(self, result: object = None) -> None:
            """Drop the value of a cell's last line."""

    class NoOutputs(DisplayPublisher):
        def publish(self, *args: object, **kwargs: object) -> None:
            """Drop what display() shows."""

    class QuietShell(InteractiveShell):
        def showtraceback(self, *args: object, **kwargs: object) -> None:
            """Formatting a traceback costs more than most cells."""

        showsyntaxerror = showtraceback
        showindentationerror = showtraceback

        def system(self, cmd: str) -> None:
            """``!command`` and ``%pip`` do nothing here, and the cell goes on."""
            self.user_ns["_exit_code"] = 127

        system_piped = system_raw = system

        def getoutput(self, cmd: str, split: bool = True, depth: int = 0) -> object:
            """``x = !command`` gives nothing."""
            return SList() if split else ""

        def enable_gui(self, gui: object = None) -> None:
            """There is no window to show."""

        def enable_matplotlib(self, gui: object = None) -> tuple[str, str]:
            """``%matplotlib inline`` would draw every figure."""
            return "inline", "agg"

    def show_nothing(response: object, *arguments: object, **options: object) -> object:
        """Do not even ask an object how it would be shown."""
        return {}, {}

    config = Config()
    config.HistoryManager.enabled = False
    shell = QuietShell.instance(
        config=config, displayhook_class=NoResults, display_pub_class=NoOutputs
    )

    shell.display_formatter.format = show_nothing

    def do_nothing(self: object, line: str = "", cell: str = "") -> None:
        """``%%bash`` and its like do nothing here."""

    ScriptMagics.shebang = do_nothing
    shell.register_magic_function(lambda line, cell: None, "cell", "script")
    return shell
