"""How many iterations RANSAC needs, and whether a simulation agrees."""

from __future__ import annotations

from notebooks.explorers.explorer import Explorer


def explore_ransac() -> Explorer:
    """Choose the share of inliers, the probability of success and the sample size.

    Shows the number of iterations that is needed, how it grows as inliers become rare, and, at the
    press of a button, what happened in a thousand simulated runs.
    """
    return Explorer(
        "ransac.js",
        {},
        "Explorer: how many iterations RANSAC needs. Open this notebook in JupyterLab to use it.",
    )
