"""Timing that treats all contenders alike."""

import statistics
import time
from collections.abc import Callable, Mapping, Sequence
from typing import TypeVar

from benchmarks.report import OURS, Row

T = TypeVar("T")


def measure(
    group: str,
    task: str,
    contenders: Mapping[str, Callable[[], object]],
    repetitions: int = 7,
    extra: dict[str, dict[str, float | str]] | None = None,
    items: dict[str, int] | None = None,
) -> list[Row]:
    """Time every contender and return a row for each, with its ratio to `OURS`.

    `contenders` maps a name to a function without arguments; the ratio is None if `OURS` is
    not among them. Each is called once untimed (caches, lazy imports). Then they take
    turns, `repetitions` rounds, so that a slow phase of the machine hits all of them; the
    median of each counts. A call under 5 ms is repeated inside its turn. Time is the
    processor time of this process: other work on the machine disturbs it little, and a
    contender with several threads pays for all of them. `extra` gives further columns for each
    contender; `items` the number of things that one call handles, if times for one are wanted.
    """
    inner = {name: _calls_per_turn(function) for name, function in contenders.items()}
    turns: dict[str, list[float]] = {name: [] for name in contenders}
    for _ in range(repetitions):
        for name, function in contenders.items():
            start = time.process_time()
            for _ in range(inner[name]):
                function()
            turns[name].append((time.process_time() - start) / inner[name])
    medians = {
        name: statistics.median(times) / (items or {}).get(name, 1) for name, times in turns.items()
    }
    return _rows(group, task, medians, extra)


def measure_fresh(
    group: str,
    task: str,
    contenders: Mapping[str, Callable[[T], object]],
    inputs: Sequence[T],
    extra: dict[str, dict[str, float | str]] | None = None,
) -> list[Row]:
    """Time every contender once on each input, and return a row for each with the median.

    They take turns on each input, so that nobody finds its code or its data in the processor's
    caches: what a program sees that does something else between two calls.
    """
    turns: dict[str, list[float]] = {name: [] for name in contenders}
    for one in inputs:
        for name, function in contenders.items():
            start = time.process_time()
            function(one)
            turns[name].append(time.process_time() - start)
    medians = {name: statistics.median(times) for name, times in turns.items()}
    return _rows(group, task, medians, extra)


def _rows(
    group: str,
    task: str,
    seconds: dict[str, float],
    extra: dict[str, dict[str, float | str]] | None,
) -> list[Row]:
    ours = seconds.get(OURS)
    return [
        Row(group, task, name, each, each / ours if ours else None, (extra or {}).get(name, {}))
        for name, each in seconds.items()
    ]


def _calls_per_turn(function: Callable[[], object], shortest_turn: float = 5e-3) -> int:
    """Call once to warm up, once more to see how many calls fill a measurable turn."""
    function()
    start = time.process_time()
    function()
    elapsed = time.process_time() - start
    return max(1, round(shortest_turn / max(elapsed, 1e-7)))
