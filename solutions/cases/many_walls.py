"""Cases with more walls, and with more people, than anybody would guess."""

import math

import numpy as np

from solutions.cases.case import Case, seed_of
from solutions.cases.consensus import axes_of


def many_walls(rng: np.random.Generator) -> Case:
    """Return a case: seven parallel walls, each with half as many points again as the next.

    So each has its share among the points that are left. Neighbours are thirty centimetres apart.
    No line across them has as many points as the largest wall that is left.
    """
    counts = (88, 55, 34, 21, 13, 8, 5)
    iterations = 120
    walls = [
        np.column_stack([np.full(count, 3.0 + 0.3 * k), np.sort(rng.uniform(-2, 2, count))])
        for k, count in enumerate(counts)
    ]
    points = rng.permutation(np.vstack(walls)) @ axes_of(rng.uniform(-3.0, 3.0))
    searches = iterations * len(counts)
    return {
        "name": "seven walls",
        "args": [points, 0.01, iterations, counts[-1], seed_of(rng)],
        "draws": (searches, math.inf),
        "samples": (2, searches, searches),
    }


def wall_in_a_crowd(rng: np.random.Generator) -> Case:
    """Return a case: less than a fifth of the points are on the only wall.

    A line through the crowd has a few points, and there the search ends, although many are left.
    """
    iterations = 450
    wall = np.column_stack([np.full(32, 3.0), np.linspace(-1, 1, 32)])
    points = rng.permutation(np.vstack([wall, rng.uniform(-1.6, 1.6, (132, 2))]))
    return {
        "name": "a wall among many people",
        "args": [points @ axes_of(rng.uniform(-3.0, 3.0)), 0.015, iterations, 20, seed_of(rng)],
        "draws": (2 * iterations, math.inf),
        "samples": (2, 2 * iterations, 2 * iterations),
    }
