"""What a function returned for an input that students may see, kept to be drawn."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from autograder.exchange.messages import Value
from autograder.exchange.unpacked_size import (
    BYTES_A_LIST,
    BYTES_A_NUMBER,
    count_parts,
    unpacked_bytes,
)

_MOST_NUMBERS = 400


def shown_outcome(cases: Sequence[dict[str, object]], outcomes: Sequence[object]) -> object:
    """The value for the first case, if that is public and the value is a few numbers.

    Only the first: `Drawn.opening` asks it before anything hidden has been sent, so that there is
    nothing yet that its value could carry out.
    """
    if not cases or not cases[0].get("public") or not isinstance(outcomes[0], dict):
        return None
    return shown_value(outcomes[0].get("value"))


def shown_value(value: object, limit: int = _MOST_NUMBERS) -> object:
    """A returned value as JSON data of at most ``limit`` numbers, in few lists.

    None if it is anything else.
    """
    count = 0

    def plain(entry: object, depth: int) -> Value:
        nonlocal count
        if isinstance(entry, np.ndarray):
            # Rows without columns are lists as well, although they hold no number.
            few = unpacked_bytes(entry.shape, 8) <= limit * (BYTES_A_NUMBER + BYTES_A_LIST)
            entry = entry.tolist() if few else None
        if isinstance(entry, list | tuple) and depth < 4:
            return [plain(inner, depth + 1) for inner in entry]
        if isinstance(entry, bool | int | float) and math.isfinite(entry) and abs(entry) < 1e12:
            count += 1
            return entry
        raise ValueError

    if count_parts(value, 3 * limit) > 3 * limit:
        return None
    try:
        found = plain(value, 0)
    except (ValueError, OverflowError):
        return None
    return found if count <= limit and count_parts(found, 3 * limit) <= 3 * limit else None
