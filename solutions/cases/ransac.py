"""Inputs and comparison for the RANSAC questions."""

import math
from typing import Any

import numpy as np

Case = dict[str, Any]


def required_iterations_cases(rng: np.random.Generator) -> list[Case]:
    """Return (p, w, s) that together tell every known mistake from the reference."""
    cases: list[Case] = [
        {"name": "half inliers, a line", "args": [0.99, 0.5, 2], "public": True},  # 17
        {"name": "half inliers, one point a sample", "args": [0.9, 0.5, 1], "public": True},  # 4
    ]
    for name, s, low, high in (
        ("a line", 2, 0.1, 0.6),
        ("a plane", 3, 0.15, 0.6),
        ("a fundamental matrix", 8, 0.4, 0.7),
    ):
        cases += [_well_posed(rng, name, s, low, high) for _ in range(3)]
    # Two, because chance may round one of them almost right without log1p.
    cases += [
        {"name": "hardly any inliers", "args": [0.95, rng.uniform(0.008, 0.01), 7]}
        for _ in range(2)
    ]
    return cases


def ransac_line_cases(rng: np.random.Generator) -> list[Case]:
    """Return walls among outliers that RANSAC finds for certain, whatever its random numbers.

    The noise is bounded by half the threshold and the outliers keep away from the wall, so
    the consensus set, and with it the fitted line, does not depend on the samples drawn.
    """
    cases = [
        _wall_among_outliers(rng, name, share, alpha)
        for name, share, alpha in (
            ("half of the points are outliers", 0.5, 0.4),
            ("two of three points are outliers", 2 / 3, 2.0),
            ("a wall behind", 0.5, -2.6),
            ("a vertical wall", 0.5, 0.0),
            ("outliers on one side only", 0.6, 1.2),
        )
    ]
    public = _wall_among_outliers(np.random.default_rng(0), "a wall and a few outliers", 0.3, 1.0)
    return [{**public, "public": True}, *cases]


def same_consensus(case: Case, expected: Any, actual: Any) -> bool:
    """Tell whether line and inliers agree: a tenth of the threshold, and the same indices."""
    try:
        (r, alpha), inliers = actual
        r, alpha = float(r), float(alpha)
        inliers = np.asarray(inliers)
    except (TypeError, ValueError, OverflowError):
        return False
    threshold = case["args"][1]
    if not (abs(r) < 1e6 and abs(alpha) <= 2 * math.pi) or inliers.dtype.kind not in "iu":
        return False
    (expected_r, expected_alpha), expected_inliers = expected
    turn = math.remainder(alpha - expected_alpha, 2 * math.pi)
    return (
        abs(r - expected_r) <= 0.1 * threshold
        and abs(turn) <= 0.1 * threshold / 3.0  # over half the wall's length
        and np.array_equal(np.sort(inliers.ravel()), np.sort(expected_inliers))
    )


def _wall_among_outliers(
    rng: np.random.Generator, name: str, outlier_share: float, alpha: float
) -> Case:
    """Return a case: 60 points of a 6 m wall and the outliers, in random order."""
    threshold, count = 0.1, 60
    normal = np.array([math.cos(alpha), math.sin(alpha)])
    along = np.array([-normal[1], normal[0]])
    r = rng.uniform(2.0, 4.0)
    # Noise at its bounds, at random: a line through two points is then clearly not the best one.
    noise = rng.choice([-0.25, 0.25], count) * threshold + rng.normal(0, 0.02, count) * threshold
    wall = np.outer(r + noise, normal) + np.outer(np.linspace(-3, 3, count), along)

    number = round(count * outlier_share / (1 - outlier_share))
    away = rng.uniform(5 * threshold, 4.0, number)
    if "one side" not in name:
        away *= rng.choice([-1.0, 1.0], number)
    clutter = np.outer(r + away, normal) + np.outer(rng.uniform(-3, 3, number), along)
    points = rng.permutation(np.vstack([wall, clutter]))
    return {"name": name, "args": [points, threshold, 300, {"rng": int(rng.integers(2**31))}]}


def _well_posed(rng: np.random.Generator, name: str, s: int, low: float, high: float) -> Case:
    """Draw p and w again until the count is far enough from a whole number to be certain."""
    while True:
        p, w = round(rng.uniform(0.8, 0.999), 3), round(rng.uniform(low, high), 3)
        if 0.05 < math.log1p(-p) / math.log1p(-(w**s)) % 1 < 0.95:
            return {"name": name, "args": [p, w, s]}
