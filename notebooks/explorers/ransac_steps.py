"""RANSAC on a scan, one sample after the other."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from notebooks.explorers.explorer import Explorer
from notebooks.explorers.points import checked_points
from notebooks.explorers.still import ransac_run

_UNANSWERED = 50  # samples of a run, while the student has not computed how many


def explore_ransac_steps(
    points: ArrayLike, iterations: object = _UNANSWERED, threshold: float = 0.06
) -> Explorer:
    """Draw samples from a scan and watch what RANSAC keeps.

    Args:
        points: shape (N, 2), metres, with 2 to 1000 points.
        iterations: how many samples a run draws; anything but a whole number from 1 to 1000, such
            as an answer that is still missing, stands for 50.
        threshold: the half width of a line's band at the start, from 0.01 to 0.5 metres.

    Raises:
        ValueError: if the points have another shape, are not finite or are all in one place.
    """
    array = checked_points(points, "explore_ransac_steps", most=1000)
    count = iterations if isinstance(iterations, int | np.integer) else _UNANSWERED
    count = int(count) if 1 <= count <= 1000 else _UNANSWERED

    def still() -> None:
        from notebooks import figures

        figures.ransac_steps(array, ransac_run(array, threshold, count, seed=1), threshold)

    return Explorer(
        "ransac_steps.js",
        {"points": array.tolist(), "iterations": count, "threshold": threshold},
        f"Explorer: RANSAC on {len(array)} points, one sample after the other. "
        "Open this notebook in JupyterLab to use it.",
        still,
    )
