"""Whether a function took as many random numbers, and as many samples, as its case asks for."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

from autograder.exchange.messages import Value
from autograder.language import _

Case = Mapping[str, Value]


class _Count(NamedTuple):
    """How many there are, and the least and the most that are asked for."""

    there_are: int
    least: int
    most: float

    @property
    def is_as_asked(self) -> bool:
        return self.least <= self.there_are <= self.most


def drew(case: Case, outcome: Mapping[str, object]) -> int:
    """0 where as much is drawn as the case asks for, 1 where it is more, -1 where it is less.

    The numbers are "draws" and the samples "samples", the ends of both included.
    """
    if "draws" in case and type(outcome.get("drawn")) is not int:
        return -1  # from this generator, nothing
    for count in (_numbers(case, outcome), _samples(case, outcome)):
        if count is not None and not count.is_as_asked:
            return 1 if count.there_are > count.most else -1
    return 0


def other_draws(case: Case, outcome: Mapping[str, object]) -> str:
    """How many numbers a function should draw with the generator it was given, if it does not."""
    return _asked_instead(_numbers(case, outcome))


def other_samples(case: Case, outcome: Mapping[str, object]) -> str:
    """How many samples a function should draw, if it can be counted that it does not."""
    return _asked_instead(_samples(case, outcome))


def asked_in_vain(case: Case, outcome: Mapping[str, object]) -> str:
    """What a case asks for and its reference does not do, so that it counts nobody's; empty if not.

    How many samples were drawn can be told only where they are drawn by `choice`.
    """
    if asked := other_draws(case, outcome):
        sentence = f'draws {outcome["drawn"]} random numbers, and "draws" asks for {asked}'
        # A reference that draws from elsewhere would find nobody's draws, not even its own.
        elsewhere = "" if outcome["drawn"] else "; only those of the generator it is given count"
        return sentence + elsewhere
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
    return _Count(drawn, *case["draws"])


def _samples(case: Case, outcome: Mapping[str, object]) -> _Count | None:
    """Whoever draws otherwise than by samples of the case's size is asked for numbers alone."""
    sampled = outcome.get("sampled")
    if "samples" not in case or not isinstance(sampled, list):
        return None
    (asked, least, most), (size, count) = case["samples"], sampled
    return _Count(count, least, most) if size == asked else None


def _asked_instead(count: _Count | None) -> str:
    if count is None or count.is_as_asked:
        return ""
    if count.least == count.most:
        return f"{count.least}"
    if math.isinf(count.most):
        return _("{low} or more").format(low=count.least)
    return _("at least {low} and at most {high}").format(low=count.least, high=count.most)
