"""When RANSAC may stop by itself, and how well a model fits instead of whether.

Sources: the stop, Hartley and Zisserman, Multiple View Geometry, algorithm 4.5; the cost, Torr and
Zisserman, MLESAC, Computer Vision and Image Understanding 78, 2000, where it is called MSAC.
"""

import numpy as np

from solutions.ransac.probabilities import required_iterations


def adaptive_stop(agreeing: np.ndarray, N: int, p: float) -> int:
    """Return after how many samples of two points an adaptive RANSAC stops.

    `agreeing` is a (k,) array of whole numbers: how many of the `N` points agree with the line of
    each sample, in the order in which they are drawn, each from 2 to N. After each sample, w is the
    share of points that agree with the best line so far. The search stops as soon as it has drawn
    as many samples as are required for w and the probability of success `p` (0 < p < 1). If that
    never happens, it has drawn all k.
    """
    best = 0
    for drawn, count in enumerate(agreeing, start=1):
        best = max(best, count)
        if drawn >= required_iterations(p, best / N, 2):
            return drawn
    return len(agreeing)


def msac_cost(offsets: np.ndarray, threshold: float) -> float:
    """Return the MSAC cost of a line: small is good.

    `offsets` are the (N,) signed distances of the points from the line, in metres. A point within
    the `threshold` on either side costs its squared distance; every other point costs the squared
    threshold, however far away it is. The cost is the sum over all points; no points cost 0.
    """
    return float(np.minimum(offsets**2, threshold**2).sum())
