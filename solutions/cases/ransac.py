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


def _well_posed(rng: np.random.Generator, name: str, s: int, low: float, high: float) -> Case:
    """Draw p and w again until the count is far enough from a whole number to be certain."""
    while True:
        p, w = round(rng.uniform(0.8, 0.999), 3), round(rng.uniform(low, high), 3)
        if 0.05 < math.log1p(-p) / math.log1p(-(w**s)) % 1 < 0.95:
            return {"name": name, "args": [p, w, s]}
