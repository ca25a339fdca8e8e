"""How much may be tried for one response: counted in steps, not in time.

So a response has the same name on a busy machine, on a slow one and on another worker of a cluster,
whatever was tried for other responses before.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from types import FrameType
from typing import Any

import numpy as np

from autograder.exchange.messages import Value
from autograder.mutants.mutant import OutOfTime


class Effort:
    """So many steps, of which each attempt takes some."""

    def __init__(self, steps: int) -> None:
        self._left = steps

    def spend(self, steps: int) -> bool:
        """Take some steps; whether there were as many left."""
        self._left -= steps
        return self._left >= 0


def numbers_in(value: Value, most: int = 10_000_000) -> int:
    """How many numbers and lists stand in a value, arrays included; it stops above ``most``."""
    left, count = [value], 0
    while left and count <= most:
        item = left.pop()
        count += item.size if isinstance(item, np.ndarray) else 1
        if isinstance(item, list | tuple):
            left += item
        elif isinstance(item, dict):
            left += item.values()
    return count


def lines_run(call: Callable[[], object], most: int) -> int | None:
    """How many lines of Python a call runs, libraries included; None if more than ``most``."""
    count = 0

    def trace(frame: FrameType, event: str, _argument: object) -> Any:
        nonlocal count
        if event == "line":
            count += 1
            if count > most:
                raise OutOfTime
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        call()
    except OutOfTime:
        return None
    finally:
        sys.settrace(before)
    return count
