"""One cloud of points in three views: in the plane, in the space of lines, and over the angle."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from notebooks.explorers.explorer import Explorer
from notebooks.explorers.points import checked_points


def explore_cloud(
    points: ArrayLike, outlier: tuple[float, float], predicted: str | None = None
) -> Explorer:
    """Drag points and one outlier, and watch the cost of all lines and the best one.

    Args:
        points: shape (N, 2), metres, with 2 to 40 points.
        outlier: x and y of one more point, in metres.
        predicted: what was predicted, to be shown beside what is true.

    Raises:
        ValueError: if the points have another shape, are not finite or are all in one place.
    """
    array = checked_points(points, "explore_cloud", most=40)
    array = checked_points(np.vstack([array, outlier]), "explore_cloud", most=41)

    def still() -> None:
        from notebooks import figures

        figures.cloud_views(array, predicted)

    return Explorer(
        "cloud.js",
        {"points": array.tolist(), "predicted": predicted or ""},
        f"Explorer: {len(array)} points, one of them an outlier, in three views. "
        "Open this notebook in JupyterLab to use it.",
        still,
    )
