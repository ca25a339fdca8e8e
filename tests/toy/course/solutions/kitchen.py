"""The right mean, the wrong ones, and the weights to try them on."""

import numpy as np


def mean_weight(weights):
    """Return the mean of `weights`, a list of numbers in grams; 0 for none."""
    if len(weights) == 0:
        return 0.0
    total = sum(weights)
    return total / len(weights)


def total_weight(weights):
    return float(sum(weights))


def middle_weight(weights):
    return float(np.median(weights)) if len(weights) else 0.0


def mean_weight_cases(rng):
    return [
        {"name": "no weights", "args": [[]]},
        {"name": "two equal weights", "args": [[3.0, 3.0]], "public": True},
        {"name": "many weights", "args": [list(map(float, rng.uniform(1, 9, 5)))]},
        {"name": "one heavy weight", "args": [[1.0, 2.0, float(rng.uniform(50, 90))]]},
    ]
