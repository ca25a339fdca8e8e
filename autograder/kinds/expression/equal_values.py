"""When the values of two expressions, taken at the same points, are the same."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Points = dict[str, NDArray[np.float64]]  # for each symbol its values, of shape (N,)
TOLERANCE = 1e-7  # relative
_OF_A_ROUNDED_NUMBER = 2e-3  # of the largest value: 3.14 for pi


def same_values(expected: np.ndarray, values: np.ndarray, period: float | None) -> bool:
    """Whether values are the expected ones where those are defined, up to multiples of a period."""
    compared = _compared(expected, values, period)
    return compared is not None and nearly_equal(*compared)


def almost_same_values(expected: np.ndarray, values: np.ndarray, period: float | None) -> bool:
    """Whether values differ from the expected ones by no more than a rounded number makes."""
    compared = _compared(expected, values, period)
    if compared is None:
        return False
    right, given = compared
    with np.errstate(all="ignore"):
        off = np.abs(given - right)
        return bool(np.all(off <= _OF_A_ROUNDED_NUMBER * np.abs(right).max()))


def _compared(
    expected: np.ndarray, values: np.ndarray, period: float | None
) -> tuple[np.ndarray, np.ndarray] | None:
    """Both where the expected ones are defined, without turns; None where nothing can be said."""
    defined = np.isfinite(expected)
    if defined.sum() < len(expected) // 4:
        return None
    expected, values = expected[defined], values[defined]
    if period is None:
        return expected, values
    difference = np.asarray(values, dtype=complex) - expected
    turns = np.round(difference.real / period)
    return (expected, values - turns * period) if np.all(np.isfinite(turns)) else None


def nearly_equal(expected: np.ndarray, actual: np.ndarray) -> bool:
    """Whether two arrays of one shape are equal, relative to the first, up to `TOLERANCE`."""
    with np.errstate(all="ignore"):
        scale = np.maximum(np.abs(expected), 1e-3)
        return bool(np.all(np.abs(actual - expected) <= TOLERANCE * scale))
