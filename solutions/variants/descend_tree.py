"""Other right ways down the tree."""

import numpy as np


def loop(descriptor, levels):
    k, node = len(levels[0]), 0
    for centers in levels:
        children = centers[k * node : k * node + k]
        node = k * node + int(np.argmin(np.linalg.norm(children - descriptor, axis=1)))
    return node


def recursion(descriptor, levels):
    return _down(descriptor, levels, len(levels[0]), 0)


def _down(descriptor, levels, k, node):
    if not levels:
        return node
    rows = range(k * node, k * node + k)
    nearest = min(rows, key=lambda row: float(((levels[0][row] - descriptor) ** 2).sum()))
    return _down(descriptor, levels[1:], k, nearest)


def reshaped_levels(descriptor, levels):
    k, path = len(levels[0]), 0
    for centers in levels:
        families = centers.reshape(-1, k, centers.shape[1])
        path = path * k + ((families[path] - descriptor) ** 2).sum(axis=-1).argmin()
    return path  # a NumPy scalar


def plain_python(descriptor, levels):
    k = len(levels[0])
    node = 0
    for level in range(len(levels)):
        best, least = None, float("inf")
        for child in range(k):
            center = levels[level][k * node + child]
            squared = sum((a - b) ** 2 for a, b in zip(center, descriptor, strict=True))
            if squared < least:
                best, least = child, squared
        node = k * node + best
    return node
