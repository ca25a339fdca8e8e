"""Inputs and comparisons for `required_iterations` and `ransac_line`."""

import math

import numpy as np

from solutions.cases.case import Case, Value, real, seed_of
from solutions.cases.consensus import (
    EXACT,
    INSIDE,
    STRICT,
    across_the_wall,
    axes_of,
    evenly_mixed,
    far_away,
    outliers_first,
)
from solutions.cases.rough_and_smooth import rough_and_smooth_wall


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
        cases += [_well_posed(rng, name, s, low, high, up=up) for up in (True, False, True)]
    cases.append(_well_posed(rng, "a small probability", 2, 0.1, 0.2, (0.1, 0.4), up=False))
    # More points in a sample than any model of the course takes.
    cases.append(_well_posed(rng, "a sample of twelve points", 12, 0.6, 0.75, up=False))
    easy = [round(rng.uniform(0.2, 0.6), 3), round(rng.uniform(0.85, 0.95), 3), 2]
    cases += [{"name": "one sample is enough", "args": args} for args in (easy, [1e-10, 0.5, 2])]
    # A half and a quarter: their logarithms are one and two times the same number, also rounded.
    cases += [
        {"name": "exactly enough", "args": args} for args in ([0.75, 0.5, 1], [0.9375, 0.5, 1])
    ]
    # Two, because chance may round one of them almost right without log1p.
    cases += [
        {"name": "hardly any inliers", "args": [0.95, rng.uniform(0.008, 0.01), 7]}
        for _ in range(2)
    ]
    cases.append({"name": "hardly any inliers", "args": [0.9, rng.uniform(1e-8, 2e-8), 2]})
    cases.append({"name": "hardly any outliers", "args": [0.9999, 0.9995, 2]})  # 1.33
    # The same shares, in samples of another size.
    cases += [{"name": "a plane after a line", "args": [0.97, 0.35, s]} for s in (2, 3, 1)]
    p, w, s = round(rng.uniform(0.5, 0.99), 3), round(rng.uniform(0.2, 0.9), 3), 3
    cases.append({"name": "nothing but inliers", "args": [p, 1.0, s]})
    # No number is enough: to say so by an exception is as right as to say so by infinity.
    cases.append({"name": "no inliers at all", "args": [p, 0.0, s], "may_raise": "ValueError"})
    cases += [
        {"name": "values out of range", "args": args}
        for args in (
            [0.0, w, s],
            [1.0, w, s],
            [-p, w, s],
            [1.0 + p, w, s],
            [p, -w, 2],
            [p, 1.0 + w, s],
        )
    ]
    return cases


def same_count(case: Case, expected: Value, actual: Value) -> bool:
    """Tell whether two numbers of iterations are equal; from 1e9 on, to nine digits.

    So large a number cannot be right to the last digit in floating point, and whoever computes it
    with more digits must not lose by that. Where the reference raises, one number is as wrong as
    another.
    """
    p, w, _ = case["args"]
    if not (0 < p < 1 and 0 <= w <= 1):
        return True
    if isinstance(actual, bool | str) or np.size(actual) != 1:
        return False
    try:
        count = real(actual)
    except (TypeError, ValueError, OverflowError):
        return False
    if not expected < math.inf:
        return count == math.inf
    if expected < 1e9:
        return bool(count == expected)
    return bool(abs(count - expected) <= 1e-9 * expected)


def ransac_line_cases(rng: np.random.Generator) -> list[Case]:
    """Return walls among outliers that RANSAC finds for certain, whatever its random numbers.

    Thresholds and sizes differ by a factor of twenty, and so do the numbers of iterations.
    """
    public = _wall(np.random.default_rng(0), "a wall and a few outliers", 1.0, 0.1, 5.0)
    small, large = (0.012, 0.02), (0.3, 0.4)
    cases = [
        _wall(
            rng,
            "half of the points are outliers",
            0.4,
            small,
            1.0,
            far=50,
            iterations=150,
            mixed=True,
        ),
        _wall(rng, "a large room", 2.0, large, 20.0, far=25, iterations=85),
        _wall(rng, "a wall behind", -2.6, small, 1.0, iterations=65),
        _wall(rng, "a vertical wall", 0.0, large, 20.0, iterations=70),
        _wall(rng, "outliers on one side only", 1.2, small, 1.0, far=30, sides=1, iterations=90),
        # 40 equal points, such as the robot's own bumper: a pair of them is no line.
        _wall(rng, "many points in one spot", -0.8, small, 1.0, far=0, spot=35, iterations=120),
        _wall(
            rng,
            "two thirds are outliers, and come first",
            2.0,
            small,
            1.0,
            far=114,
            iterations=240,
            crowd=True,
        ),
        *(_wall_and_two_patches(rng) for _ in range(3)),
        rough_and_smooth_wall(rng, small, 1.0),
        rough_and_smooth_wall(rng, large, 20.0),
    ]
    exact = exact_wall(rng)
    cloud, threshold = cases[2]["args"][:2]
    spot = np.tile(rng.integers(64, 192, 2) / 64, (40, 1))  # exact in float32 as well
    above, beside = spot[:1] + np.array([[[0.0, 0.125]], [[0.125, 0.0]]])
    # Whole numbers: the lines of any two of them go through the origin exactly.
    through_origin = np.outer(rng.permutation(np.arange(1.0, 10.0)), rng.integers(1, 5, 2))
    cases += [
        # Nearer to each other than the threshold, and different all the same.
        {"name": "two points", "args": [np.vstack([spot[:1], beside]), 0.3, 3, seed_of(rng)]},
        # A sample of two different points is a line the first time, whatever is drawn.
        *(
            {"name": "two points", "args": [rng.uniform(1, 3, (2, 2)), 0.1, 1, seed_of(rng)]}
            for _ in range(10)
        ),
        {"name": "a wall through the origin", "args": [through_origin, 0.05, 5, seed_of(rng)]},
        # A line is found only by a sample that holds the point elsewhere; it is level or upright.
        {
            "name": "all points but the last in one spot",
            "args": [np.vstack([spot, above]), 0.03, 340, seed_of(rng)],
            "draws": (340, math.inf),
        },
        {
            "name": "all points but the first in one spot",
            "args": [np.vstack([beside, spot]), 0.03, 340, seed_of(rng)],
            "draws": (340, math.inf),
        },
        {
            "name": "no outliers, one iteration",
            "args": [exact, threshold, 1, seed_of(rng)],
            "draws": (1, 4 * len(exact)),
            "samples": (2, 1, 1),
        },
        {
            "name": "no outliers, thirty iterations",
            "args": [exact, threshold, 30, seed_of(rng)],
            "draws": (30, 30 * 4 * len(exact)),  # a sample may be the head of a permutation
            "samples": (2, 30, 30),
        },
        {"name": "no iterations", "args": [cloud, threshold, 0, seed_of(rng)]},
        {"name": "no iterations", "args": [exact, threshold, 0, seed_of(rng)]},
        {"name": "all points equal", "args": [spot, threshold, 8, seed_of(rng)]},
    ]
    return [{**public, "public": True}, *cases]


def same_consensus(case: Case, expected: Value, actual: Value) -> bool:
    """Tell whether line and inliers agree: a hundredth of the threshold, and the same indices.

    What a mistake finds depends on its random numbers. If `expected` is no consensus set of the
    case's threshold, it is enough that both have most of their points in common. Where there is
    no line, and the reference raises, one value is as wrong as another.
    """
    points, threshold, iterations = case["args"][:3]
    if iterations == 0 or not np.ptp(points, axis=0).any():
        return True
    try:
        (r, alpha), inliers = actual
        r, alpha = real(r), real(alpha)
        inliers = np.asarray(inliers)
    except (TypeError, ValueError, OverflowError):
        return False
    if not (abs(r) < 1e6 and abs(alpha) <= 2 * math.pi) or inliers.dtype.kind not in "iu":
        return False
    (expected_r, expected_alpha), expected_inliers = expected
    offsets = points @ axes_of(expected_alpha)[0] - expected_r
    sound = np.array_equal(np.flatnonzero(np.abs(offsets) <= threshold), np.sort(expected_inliers))
    # A normal that is turned round belongs to the same line where that goes through the origin.
    through_origin = max(abs(r), abs(expected_r)) <= 0.01 * threshold
    turn = math.remainder(alpha - expected_alpha, math.pi if through_origin else 2 * math.pi)
    size = max(1e-9, float(np.ptp(points, axis=0).max()) / 2)
    off = max(abs(r - expected_r), abs(turn) * size) / threshold
    if sound:
        return off <= 0.01 and np.array_equal(np.sort(inliers.ravel()), np.sort(expected_inliers))
    return off <= 1.0 and overlap(inliers, expected_inliers) >= 0.9


def overlap(one: np.ndarray, other: np.ndarray) -> float:
    """Return how many of the points of two sets they have in common, from 0 to 1."""
    either = len(np.union1d(one, other))
    return len(np.intersect1d(one, other)) / either if either else 1.0


def _wall(
    rng: np.random.Generator,
    name: str,
    alpha: float,
    threshold: float | tuple[float, float],
    scale: float,
    *,
    far: int = 16,
    sides: int = 2,
    spot: int = 0,
    iterations: int = 100,
    mixed: bool = False,
    crowd: bool = False,
) -> Case:
    """Return a case: 46 or 56 points along a wall of six times the scale, and outliers.

    They are shuffled, or evenly mixed, or a crowd of outliers comes first.
    """
    if isinstance(threshold, tuple):
        threshold = float(rng.uniform(*threshold))
    r, count = rng.uniform(2.0, 4.0) * scale, 50 if crowd else 40
    bulk, middle = across_the_wall(rng, threshold, count, EXACT if crowd else STRICT, sides)
    others = far_away(rng, threshold, max(4.0 * scale, 30 * threshold), far, sides)
    positions = np.concatenate(
        [np.linspace(-3, 3, count), rng.uniform(-0.02, 0.02, len(middle)), rng.uniform(-3, 3, far)]
    )
    offsets = r + np.concatenate([bulk, middle, others])
    points = np.column_stack([offsets, positions * scale])
    points = np.vstack([points, np.tile([r + 1.5 * scale, 2.0 * scale], (spot, 1))])
    points = points @ axes_of(alpha)
    on_it = count + 2 * INSIDE
    if crowd:
        points = outliers_first(rng, points[:on_it], points[on_it:])
    else:
        points = evenly_mixed(points[:on_it], points[on_it:]) if mixed else rng.permutation(points)
    return {
        "name": name,
        "args": [points, threshold, iterations, seed_of(rng)],
        "draws": (iterations, math.inf),
        # In place of two equal points one may draw again.
        "samples": (2, iterations, math.inf if spot else iterations),
    }


def _wall_and_two_patches(rng: np.random.Generator) -> Case:
    """Return a case: 29 points along a wall, and 28 in two patches on another line.

    The wall has one point more, but hardly any two of its points have all others between them.
    """
    threshold, iterations = 0.02, 70
    wall = np.column_stack([np.linspace(-3, 3, 29), np.full(29, 2.0)])
    patches = np.repeat([[4.5, -1.0], [4.5, -3.0]], 14, axis=0)
    patches = patches + rng.uniform(-0.3, 0.3, (28, 2)) * threshold
    points = rng.permutation(np.vstack([wall, patches])) @ axes_of(rng.uniform(-3.0, 3.0))
    return {
        "name": "another line has its points in two patches",
        "args": [points, threshold, iterations, seed_of(rng)],
        "draws": (iterations, math.inf),
        "samples": (2, iterations, iterations),
    }


def exact_wall(rng: np.random.Generator) -> np.ndarray:
    """Return 12 points exactly on a line: any two of them find it."""
    points = np.column_stack([np.full(12, rng.uniform(2.0, 3.0)), np.linspace(-1.0, 1.0, 12)])
    return rng.permutation(points @ axes_of(rng.uniform(-3.0, 3.0)))


def _well_posed(
    rng: np.random.Generator,
    name: str,
    s: int,
    low: float,
    high: float,
    of_p: tuple[float, float] = (0.8, 0.999),
    *,
    up: bool,
) -> Case:
    """Draw p and w again until the count is far enough from a whole number to be certain.

    `up` says whether `round` would round it up as well: what it is worth is not left to chance.
    """
    while True:
        p, w = round(rng.uniform(*of_p), 3), round(rng.uniform(low, high), 3)
        fraction = math.log1p(-p) / math.log1p(-(w**s)) % 1
        if (0.55 if up else 0.05) < fraction < (0.95 if up else 0.45):
            return {"name": name, "args": [p, w, s]}
