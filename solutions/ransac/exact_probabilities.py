"""RANSAC's probabilities when the points of one sample are all different.

After the first inlier is drawn, one inlier fewer is left. The formulas of
`solutions.ransac.probabilities` leave that out; here it is counted.
"""

import math

from solutions.ransac import probabilities as approximate


def all_inlier_probability(N: int, inliers: int, s: int) -> float:
    """Return the probability that s different points drawn from N are all inliers."""
    if not 0 <= inliers <= N or not 1 <= s <= N:
        raise ValueError(
            f"Needs 0 <= inliers <= N and 1 <= s <= N, not inliers={inliers}, s={s}, N={N}."
        )
    return math.comb(inliers, s) / math.comb(N, s)


# One draw of a whole sample is one draw of a "point" that is good with that probability.


def required_iterations(p: float, N: int, inliers: int, s: int) -> int | float:
    """Return the exact number of samples for an all-inlier one with probability p."""
    return approximate.required_iterations(p, all_inlier_probability(N, inliers, s), 1)


def outlier_model_probability(N: int, inliers: int, s: int, k: float = 1) -> float:
    """Return the exact probability that none of k samples was free of outliers."""
    return approximate.outlier_model_probability(all_inlier_probability(N, inliers, s), 1, k)


def success_probability(N: int, inliers: int, s: int, k: float) -> float:
    """Return the exact probability that at least one of k samples was free of outliers."""
    return approximate.success_probability(all_inlier_probability(N, inliers, s), 1, k)
