"""When the values of two expressions, taken at the same points, are the same."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Points = dict[str, NDArray[np.float64]]  # for each symbol its values, of shape (N,)
TOLERANCE = 1e-7  # relative


def same_values(expected: np.ndarray, values: np.ndarray, period: float | None) -> bool:
    """Whether values are the expected ones where those are defined, up to multiples of a period."""
    defined = np.isfinite(expected)
    if defined.sum() < len(expected) // 4:
        return False
    expected, values = expected[defined], values[defined]
    if period is None:
        return nearly_equal(expected, values)
    difference = np.asarray(values, dtype=complex) - expected
    turns = np.round(difference.real / period)
    return bool(np.all(np.isfinite(turns))) and nearly_equal(expected, values - turns * period)


def nearly_equal(expected: np.ndarray, actual: np.ndarray) -> bool:
    """Whether two arrays of one shape are equal, relative to the first, up to `TOLERANCE`."""
    with np.errstate(all="ignore"):
        scale = np.maximum(np.abs(expected), 1e-3)
        return bool(np.all(np.abs(actual - expected) <= TOLERANCE * scale))
