"""A line in polar form among points: turn it, push it, and watch the cost."""

from __future__ import annotations

from numpy.typing import ArrayLike

from notebooks.explorers.explorer import Explorer
from notebooks.explorers.points import checked_points

MOST_POINTS = 500


def explore_polar_line(points: ArrayLike) -> Explorer:
    """Drag a line until its cost S is as small as you can make it.

    Args:
        points: shape (N, 2), metres, with 2 to 500 points.

    Raises:
        ValueError: if the points have another shape or are not finite or are all in one place.
    """
    array = checked_points(points, "explore_polar_line", MOST_POINTS)
    return Explorer(
        "polar_line.js",
        {"points": array.tolist()},
        f"Explorer: a line in polar form among {len(array)} points. "
        "Open this notebook in JupyterLab to use it.",
    )
