"""The entries of a list that a student gives in code, whichever library made it."""

from __future__ import annotations

from typing import Any

import numpy as np


def given_entries(response: object) -> list[Any] | None:
    """Python's own values of a list, tuple, range or array; None if it is none of them."""
    if isinstance(response, np.ndarray):
        response = response.tolist()
    if not isinstance(response, list | tuple | range):
        return None
    return [entry.item() if isinstance(entry, np.generic) else entry for entry in response]
