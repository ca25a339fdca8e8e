"""A line in polar form among points: turn it, push it, and watch the cost."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from notebooks.explorers.explorer import Explorer

MOST_POINTS = 500


def explore_polar_line(points: ArrayLike) -> Explorer:
    """Drag a line until its cost S is as small as you can make it.

    Args:
        points: shape (N, 2), metres, with 2 to 500 points.

    Raises:
        ValueError: if the points have another shape or are not finite.
    """
    array = np.asarray(points, dtype=float)
    if array.ndim != 2 or array.shape[1] != 2 or not 2 <= len(array) <= MOST_POINTS:
        raise ValueError(
            f"explore_polar_line needs 2 to {MOST_POINTS} points of shape (N, 2), "
            f"not {array.shape}."
        )
    if not np.isfinite(array).all():
        raise ValueError("explore_polar_line needs finite points; leave out NaN and infinity.")
    return Explorer(
        "polar_line.js",
        {"points": array.round(6).tolist()},
        f"Explorer: a line in polar form among {len(array)} points. "
        "Open this notebook in JupyterLab to use it.",
    )
