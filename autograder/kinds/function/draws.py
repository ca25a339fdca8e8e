"""Whether a function took as many random numbers, and as many samples, as its case asks for."""

from __future__ import annotations

import math
from collections.abc import Mapping

from autograder.exchange.messages import Value
from autograder.language import _

Case = Mapping[str, Value]
_Count = tuple[int, int, float]  # how many there are, and the least and the most asked for


def drew(case: Case, outcome: Mapping[str, object]) -> int:
    """0 where as much is drawn as the case asks for, 1 where it is more, -1 where it is less.

    The numbers are "draws" and the samples "samples", the ends of both included.
    """
    if "draws" in case and type(outcome.get("drawn")) is not int:
        return -1  # from this generator, nothing
    for counted in (_numbers(case, outcome), _samples(case, outcome)):
        if counted is not None and not counted[1] <= counted[0] <= counted[2]:
            return 1 if counted[0] > counted[2] else -1
    return 0


def other_draws(case: Case, outcome: Mapping[str, object]) -> str:
    """How many numbers a function should draw with the generator it was given, if it does not."""
    return _other(_numbers(case, outcome))


def other_samples(case: Case, outcome: Mapping[str, object]) -> str:
    """How many samples a function should draw, if it can be counted that it does not."""
    return _other(_samples(case, outcome))


def asked_in_vain(case: Case, outcome: Mapping[str, object]) -> str:
    """What a case asks for and its reference does not do, so that it counts nobody's; empty if not.

    How many samples were drawn can be told only where they are drawn by `choice`.
    """
    if asked := other_draws(case, outcome):
        return f'draws {outcome["drawn"]} random numbers, and "draws" asks for {asked}'
    sampled = outcome.get("sampled")
    if "samples" not in case or not isinstance(sampled, list):
        return ""
    size, count = sampled
    if asked := other_samples(case, outcome):
        return f'draws {count} samples, and "samples" asks for {asked}'
    wanted = case["samples"][0]
    return (
        "" if size == wanted else f'draws samples of {size}, and "samples" counts those of {wanted}'
    )


def _numbers(case: Case, outcome: Mapping[str, object]) -> _Count | None:
    drawn = outcome.get("drawn")
    if "draws" not in case or type(drawn) is not int:
        return None
    low, high = case["draws"]
    return drawn, low, high


def _samples(case: Case, outcome: Mapping[str, object]) -> _Count | None:
    """Whoever draws otherwise than by samples of the case's size is asked for numbers alone."""
    sampled = outcome.get("sampled")
    if "samples" not in case or not isinstance(sampled, list):
        return None
    (asked, low, high), (size, count) = case["samples"], sampled
    return (count, low, high) if size == asked else None


def _other(counted: _Count | None) -> str:
    if counted is None or counted[1] <= counted[0] <= counted[2]:
        return ""
    _count, low, high = counted
    if low == high:
        return f"{low}"
    if math.isinf(high):
        return _("{low} or more").format(low=low)
    return _("at least {low} and at most {high}").format(low=low, high=high)
