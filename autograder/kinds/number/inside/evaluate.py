"""A value as a plain number. Runs beside the student's code."""

from __future__ import annotations

from autograder.exchange.messages import Message
from autograder.sandbox.inside.plain_data import only_entry, plain_number


def evaluate(response: object, probe: dict[str, object]) -> Message:
    """The number that a response holds.

    Raises:
        Unusable: if it is none.
    """
    return {"value": plain_number(only_entry(response))}
