"""Other right ways to find all walls."""

import numpy as np

from solutions.ransac.fast.consensus import ransac_line as all_at_once
from solutions.ransac.line import ransac_line


def recursion(points, threshold, iterations, min_points, rng):
    return _walls_in(np.arange(len(points)), points, threshold, iterations, min_points, rng)


def _walls_in(left, points, threshold, iterations, min_points, rng):
    if len(left) < min_points:
        return []
    line, inliers = ransac_line(points[left], threshold, iterations, rng)
    if len(inliers) < min_points:
        return []
    others = np.delete(left, inliers)
    return [
        (line, left[inliers]),
        *_walls_in(others, points, threshold, iterations, min_points, rng),
    ]


def a_mask(points, threshold, iterations, min_points, rng):
    free, walls = np.ones(len(points), dtype=bool), []
    while free.sum() >= min_points:
        indices = np.flatnonzero(free)
        consensus = all_at_once(points[free], threshold, iterations, rng)
        if consensus is None or len(consensus.inliers) < min_points:
            return walls
        line, inliers, _ = consensus
        walls.append([tuple(line), indices[inliers].tolist()])
        free[indices[inliers]] = False
    return walls


def numbered_points(points, threshold, iterations, min_points, rng):
    left, walls = dict(enumerate(points)), []
    while len(left) >= max(min_points, 2):
        numbers = list(left)
        consensus = all_at_once(np.array(list(left.values())), threshold, iterations, rng)
        if consensus is None or len(consensus.inliers) < min_points:
            break
        found, inliers, _ = consensus
        wall = [numbers[i] for i in inliers]
        walls.append((found, np.array(wall)))
        for number in wall:
            del left[number]
    return walls


def labels(points, threshold, iterations, min_points, rng):
    label, lines = np.full(len(points), -1), []
    while True:
        left = np.where(label < 0)[0]
        if left.size < min_points:
            break
        consensus = all_at_once(points[left], threshold, iterations, rng)
        if consensus is None or consensus.inliers.size < min_points:
            break
        line, inliers, _ = consensus
        label[left[inliers]] = len(lines)
        lines.append(line)
    return [(line, np.flatnonzero(label == number)) for number, line in enumerate(lines)]
