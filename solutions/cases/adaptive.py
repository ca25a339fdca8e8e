"""Inputs and comparisons for `adaptive_stop` and `msac_cost`."""

import math

import numpy as np

from solutions.cases.case import Case, Value, real


def adaptive_stop_cases(rng: np.random.Generator) -> list[Case]:
    """Return runs that stop early, late, at a worse sample, and not at all."""
    # 49 samples for the first, 48 for the second: one more point in a hundred counts.
    slightly = np.array([300, 303, *rng.integers(2, 300, 60)])
    # When the best sample of all comes, the search has stopped.
    late = np.array([5, 50, 7, 9] * 10 + [90])
    example = [np.array([20, 50, 30] * 10), 100, 0.99]
    public = {"name": "half of the points agree in the end", "args": example, "public": True}
    cases: list[Case] = []
    for name, low, high, p in (
        ("many inliers", 0.4, 0.6, 0.95),
        ("few inliers", 0.2, 0.25, 0.9),
        ("almost certain", 0.5, 0.6, 0.999),
        ("hardly any inliers", 0.16, 0.18, 0.999),  # more than two hundred samples
    ):
        cases += [{"name": name, "args": _run(rng, low, high, p, at)} for at in (4, 90)]
    count = int(rng.integers(40, 60))
    short = np.full(6, count)  # needs more than ten
    cases += [
        {"name": "the run is too short", "args": [short, 200, 0.95]},
        {"name": "all points agree", "args": [np.array([3, 200, 5, 4]), 200, 0.95]},
        {"name": "all points agree", "args": [np.array([200, 3, 5, 4]), 200, 0.999]},
        {"name": "slightly better", "args": [slightly, 1000, 0.99]},
        {"name": "a better sample after the last", "args": [late, 100, 0.95]},
        {"name": "the first sample is enough", "args": [np.array([190, 3, 3]), 200, 0.5]},
        {"name": "exactly as many as there are", "args": [np.full(11, 50), 100, 0.95]},  # 10.41
        {"name": "ten points", "args": [np.full(30, 5), 10, 0.95]},
    ]
    return [public, *cases]


def msac_cost_cases(rng: np.random.Generator) -> list[Case]:
    """Return distances on both sides of lines, with thresholds of many sizes."""
    public = {"name": "three points", "args": [np.array([0.1, -0.2, 5.0]), 0.3], "public": True}
    cases = [public]
    sizes = (("a room", 0.05, 40), ("a hall", 2.0, 60), ("a desk", 0.004, 25))
    for name, threshold, count in sizes:
        near = rng.uniform(-1, 1, count) * threshold
        far = rng.choice([-1, 1], count) * rng.uniform(1.2, 40, count) * threshold
        cases.append({"name": name, "args": [rng.permutation(np.append(near, far)), threshold]})
    cases += [
        {"name": "all within", "args": [rng.uniform(-0.9, 0.9, 20), 1.0]},
        {"name": "all outside, on one side", "args": [-rng.uniform(1.1, 9, 20), 1.0]},
        # Points of a grid: many are equally far away.
        {"name": "equal distances", "args": [rng.integers(-6, 7, 40) / 8, 0.5]},
        {"name": "no points", "args": [np.array([]), 0.1]},
    ]
    return cases


def same_stop(case: Case, expected: Value, actual: Value) -> bool:
    """Tell whether two numbers of samples are equal; a float that is whole is a whole number."""
    if isinstance(actual, bool | str) or np.size(actual) != 1:
        return False
    try:
        return real(actual) == float(expected)
    except (TypeError, ValueError, OverflowError):
        return False


def same_cost(case: Case, expected: Value, actual: Value) -> bool:
    """Tell whether two costs are equal to six digits, as float32 gives them."""
    if isinstance(actual, bool | str) or np.size(actual) != 1:
        return False
    try:
        cost = real(actual)
    except (TypeError, ValueError, OverflowError):
        return False
    return math.isclose(cost, float(expected), rel_tol=1e-5, abs_tol=1e-12)


def _run(rng: np.random.Generator, low: float, high: float, p: float, at: int) -> list[Value]:
    """Return a run of 400 samples: poor ones, a fair one soon, the best one at an index.

    The best share is far enough from those at which the number of samples jumps.
    """
    while True:
        N = int(rng.integers(300, 500))  # for some N there is no such share
        best = int(rng.uniform(low, high) * N)
        fraction = math.log1p(-p) / math.log1p(-((best / N) ** 2)) % 1
        if 0.1 < fraction < 0.4:  # `round` would round it down
            break
    agreeing = rng.integers(2, int(0.1 * N), 400)
    agreeing[3] = int(0.15 * N)
    agreeing[at] = best
    return [agreeing, N, p]
