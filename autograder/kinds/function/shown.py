"""What a function returned for an input that students may see, kept to be drawn."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np


def shown_outcome(cases: Sequence[dict[str, Any]], outcomes: Sequence[Any]) -> Any:
    """The value for the first case, if that is public and the value is a few numbers.

    Only the first: `Drawn.opening` asks it before anything hidden has been sent, so that there is
    nothing yet that its value could carry out.
    """
    if not cases or not cases[0].get("public") or not isinstance(outcomes[0], dict):
        return None
    return shown_value(outcomes[0].get("value"))


def shown_value(value: Any, limit: int = 400) -> Any:
    """A returned value as JSON data of at most ``limit`` numbers; None if it is anything else."""
    count = 0

    def plain(entry: Any, depth: int) -> Any:
        nonlocal count
        if isinstance(entry, np.ndarray):
            entry = entry.tolist() if entry.size <= limit else None
        if isinstance(entry, list | tuple) and depth < 4:
            return [plain(inner, depth + 1) for inner in entry]
        if isinstance(entry, bool | int | float) and math.isfinite(entry) and abs(entry) < 1e12:
            count += 1
            return entry
        raise ValueError

    try:
        found = plain(value, 0)
    except (ValueError, OverflowError):
        return None
    return found if count <= limit else None
