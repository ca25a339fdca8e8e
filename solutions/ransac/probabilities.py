"""How many random samples RANSAC needs, and how likely it is to fail.

Symbols as on the sheet: w is the share of inliers, s the points in one sample (2 for a
line, 3 for a plane), k the number of iterations, p the wanted probability of success. These
formulas take the point cloud as so large that removing a point does not change w;
`solutions.ransac.exact_probabilities` counts exactly.

Everything goes through log1p and expm1: for a small w**s, `1 - w**s` rounds to 1.
"""

import math


def required_iterations(p: float, w: float, s: int) -> int | float:
    """Return how many samples to draw so that, with probability p, one of them has no outlier.

    `p` is that probability (0 < p < 1), `w` the share of inliers (0 to 1), and `s` the number of
    points in a sample (1 or more). The result is the smallest whole number that is enough; of a
    very large one, nine digits are. It is right even where w**s is so small that 1 - w**s is
    rounded to 1. For w = 1 one sample is enough: the result is 1. For w = 0 no number is enough:
    the result is math.inf, or a ValueError is raised.

    Raises:
        ValueError: if p or w is out of range.
    """
    if not (0 < p < 1 and 0 <= w <= 1 and s >= 1):
        raise ValueError(f"Needs 0 < p < 1, 0 <= w <= 1 and s >= 1, not p={p}, w={w}, s={s}.")
    all_inliers = w**s
    if all_inliers == 1:
        return 1
    if all_inliers == 0:
        return math.inf
    iterations = math.log1p(-p) / math.log1p(-all_inliers)
    if iterations == math.inf:  # beyond all floats
        return math.inf
    return max(1, math.ceil(iterations - 1e-9))  # 3.0000000000000004 means 3


def candidate_count(N: int, s: int) -> int:
    """Return how many different samples of s points there are among N points."""
    return math.comb(N, s)


def outlier_model_probability(w: float, s: int, k: float = 1) -> float:
    """Return the probability that none of k samples was free of outliers.

    `k` may be math.inf.

    Raises:
        ValueError: if w, s or k is out of range.
    """
    return math.exp(_log_failure(w, s, k))


def success_probability(w: float, s: int, k: float) -> float:
    """Return the probability that at least one of k samples was free of outliers.

    `k` may be math.inf.

    Raises:
        ValueError: if w, s or k is out of range.
    """
    return 0.0 - math.expm1(_log_failure(w, s, k))


def _log_failure(w: float, s: int, k: float) -> float:
    """Return the logarithm of (1 - w**s)**k, from -inf to 0."""
    if not (0 <= w <= 1 and s >= 1 and k >= 0):
        raise ValueError(f"Needs 0 <= w <= 1, s >= 1 and k >= 0, not w={w}, s={s}, k={k}.")
    all_inliers = w**s
    if k == 0 or all_inliers == 0:  # neither has any chance, even if the other is infinite
        return 0.0
    return -math.inf if all_inliers == 1 else k * math.log1p(-all_inliers)
