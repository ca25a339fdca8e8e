"""Points that an explorer is given, checked once for all explorers."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike


def checked_points(points: ArrayLike, name: str, most: int) -> np.ndarray:
    """Return points as an array of shape (N, 2), rounded to a micrometre as the browser gets them.

    Args:
        points: shape (N, 2), metres.
        name: the function that was called, for the error.
        most: the largest N that can be drawn quickly.

    Raises:
        ValueError: if the points have another shape, are not finite or are all in one place.
    """
    array = np.asarray(points, dtype=float)
    if array.ndim != 2 or array.shape[1] != 2 or not 2 <= len(array) <= most:
        raise ValueError(f"{name} needs 2 to {most} points of shape (N, 2), not {array.shape}.")
    if not np.isfinite(array).all():
        raise ValueError(f"{name} needs finite points; leave out NaN and infinity.")
    array = array.round(6)
    if (array == array[0]).all():
        raise ValueError(f"{name} needs points at different places; all of these are in one.")
    return array
