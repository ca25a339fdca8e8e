"""Other right ways to write RANSAC for a line."""

import math

import numpy as np

from solutions.lines.line_fitting import distances, fit_line


def cross_products(points, threshold, iterations, rng):
    best = None
    for _ in range(iterations):
        i, j = rng.choice(len(points), 2, replace=False)
        d = points[j] - points[i]
        length = np.hypot(*d)
        if length == 0:
            continue
        offsets = (points - points[i]) @ np.array([-d[1], d[0]]) / length
        inliers = np.flatnonzero(offsets**2 <= threshold**2)
        if best is None or len(inliers) > len(best):
            best = inliers
    if best is None:
        raise ValueError("no line")
    return fit_line(points[best]), best


def consensus_kept(points, threshold, iterations, rng):
    best = np.array([], dtype=int)
    for _ in range(iterations):
        pair = points[rng.choice(len(points), 2, replace=False)]
        if (pair[0] == pair[1]).all():
            continue
        offsets = distances(points, fit_line(pair))
        inliers = np.flatnonzero(np.abs(offsets) <= threshold)
        if len(inliers) > len(best):
            best = inliers
    if len(best) == 0:
        raise ValueError("no line")
    return fit_line(points[best]), best


def all_at_once(points, threshold, iterations, rng):
    N = len(points)
    first = rng.integers(N, size=iterations)
    second = (first + rng.integers(1, N, size=iterations)) % N
    along = points[second] - points[first]
    lengths = np.linalg.norm(along, axis=1)
    if not (lengths > 0).any():
        raise ValueError("No sample had two different points.")
    first, along, lengths = first[lengths > 0], along[lengths > 0], lengths[lengths > 0]
    normals = np.column_stack([-along[:, 1], along[:, 0]]) / lengths[:, None]
    offsets = normals @ points.T - (normals * points[first]).sum(axis=1)[:, None]
    agreeing = np.abs(offsets) <= threshold
    line = fit_line(points[agreeing[agreeing.sum(axis=1).argmax()]])
    return tuple(line), np.nonzero(np.abs(distances(points, line)) <= threshold)[0]


def plain_loops(points, threshold, iterations, rng):
    best = []
    for _ in range(iterations):
        (ax, ay), (bx, by) = rng.choice(points, 2, replace=False)
        length = math.hypot(bx - ax, by - ay)
        if length == 0:
            continue
        agreeing = []
        for index, (x, y) in enumerate(points):
            area = (bx - ax) * (y - ay) - (by - ay) * (x - ax)
            if abs(area) / length <= threshold:
                agreeing.append(index)
        if len(agreeing) > len(best):
            best = agreeing
    if not best:
        raise ValueError("no line")
    return list(fit_line(points[best])), best


def masks_and_several_refits(points, threshold, iterations, rng):
    best = np.zeros(len(points), dtype=bool)
    for _ in range(iterations):
        i = j = rng.integers(len(points))
        while j == i:
            j = rng.integers(len(points))
        if (points[i] == points[j]).all():
            continue
        mask = np.abs(distances(points, fit_line(points[[i, j]]))) < threshold
        if mask.sum() > best.sum():
            best = mask
    if not best.any():
        raise ValueError("nothing agreed")
    for _ in range(4):
        line = fit_line(points[best])
        best = np.abs(distances(points, line)) < threshold
    return line, np.where(best)[0]


def permutations(points, threshold, iterations, rng):
    found = []
    for _ in range(iterations):
        pair = points[rng.permutation(len(points))[:2]]
        if not np.array_equal(pair[0], pair[1]):
            offsets = distances(points, fit_line(pair))
            found.append(set(np.flatnonzero(np.abs(offsets) <= threshold).tolist()))
    if not found:
        raise ValueError("no line")
    inliers = sorted(max(found, key=len))
    return fit_line(points[inliers]), np.array(inliers)
