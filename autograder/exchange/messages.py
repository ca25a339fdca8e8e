"""What a sandbox replies, once `autograder.exchange.replies` has checked it: known fields only."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NotRequired, TypedDict

Value = Any  # an argument or a result: numbers, texts, lists, dictionaries, arrays of any shape
Values = Mapping[str, Value]  # a case by its arguments' names, or an outcome by what it is
Message = dict[str, Any]  # on its way: JSON and arrays, of which nothing is known before the check


class Told(TypedDict):
    """What was told of an exception: its class, message, and maybe the line that raised it."""

    kind: str
    message: str
    module: str
    line: int  # 0 if it is not known
    source: str


class Report(TypedDict):
    """A run: the error (a class name or None) and what was told of it, one each a cell."""

    errors: list[str | None]
    told: list[Told | None]
    responses: dict[str, object]
    understood: dict[str, str]


class Outcome(TypedDict, total=False):
    """What one call gave: ``value``, ``raised`` (a class name) or ``unusable`` (a reason)."""

    value: object
    raised: str
    unusable: str
    changed: bool  # an argument, in place
    drawn: int  # numbers taken from a generator
    sampled: list[int]  # the size and the number of the samples, if nothing else was taken


class Evaluation(TypedDict):
    """The reply to a probe; ``state`` says which of the other fields there are."""

    state: str  # not attempted, raised, unusable or given
    error: NotRequired[str]
    reason: NotRequired[str]
    outcomes: NotRequired[list[Outcome]]
    told: NotRequired[Told]
    values: NotRequired[Value]  # an array of any shape and type
    value: NotRequired[int | float | complex]
