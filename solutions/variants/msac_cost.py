"""Other right ways to write the cost of MSAC."""

import numpy as np


def plain_loop(offsets, threshold):
    cost = 0.0
    for distance in offsets:
        cost += distance**2 if abs(distance) <= threshold else threshold**2
    return cost


def clipped(offsets, threshold):
    return np.square(np.clip(offsets, -threshold, threshold)).sum()


def masked(offsets, threshold):
    near = np.abs(offsets) < threshold
    return (offsets[near] ** 2).sum() + np.count_nonzero(~near) * threshold * threshold


def dot_product(offsets, threshold):
    capped = np.where(np.abs(offsets) > threshold, threshold, offsets)
    return capped @ capped


def single_precision(offsets, threshold):
    return np.minimum(np.float32(offsets) ** 2, np.float32(threshold) ** 2).sum()
