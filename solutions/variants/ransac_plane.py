"""Other right ways to write RANSAC for a plane."""

import numpy as np

from solutions.lines.plane_fitting import fit_plane, plane_distances


def unit_normals(points, threshold, iterations, rng):
    best = np.zeros(len(points), dtype=bool)
    for _ in range(iterations):
        a, b, c = points[rng.choice(len(points), 3, replace=False)]
        normal = np.cross(b - a, c - a)
        if not normal.any():
            continue
        normal = normal / np.linalg.norm(normal)
        mask = np.abs((points - a) @ normal) < threshold
        if mask.sum() > best.sum():
            best = mask
    if not best.any():
        raise ValueError("no plane")
    return fit_plane(points[best]), np.flatnonzero(best)


def all_at_once(points, threshold, iterations, rng):
    if iterations < 1:
        raise ValueError("no samples")
    triples = rng.random((iterations, len(points))).argsort(axis=1)[:, :3]
    a, b, c = points[triples].transpose(1, 0, 2)
    normals = np.cross(b - a, c - a)
    lengths = np.linalg.norm(normals, axis=1)
    keep = lengths > 0
    if not keep.any():
        raise ValueError("every sample was on one line")
    normals = normals[keep] / lengths[keep, None]
    offsets = normals @ points.T - (normals * a[keep]).sum(axis=1)[:, None]
    agreeing = np.abs(offsets) <= threshold
    plane = fit_plane(points[agreeing[agreeing.sum(axis=1).argmax()]])
    return tuple(plane), np.flatnonzero(np.abs(plane_distances(points, plane)) <= threshold)


def nothing_agrees_with_nan(points, threshold, iterations, rng):
    best = []
    for _ in range(iterations):
        a, b, c = rng.permutation(points)[:3]
        with np.errstate(invalid="ignore"):
            normal = np.cross(b - a, c - a)
            normal = normal / np.sqrt(normal @ normal)
            offsets = abs((points - a) @ normal).tolist()
            inliers = [i for i, offset in enumerate(offsets) if offset <= threshold]
        if len(inliers) > len(best):
            best = inliers
    if not best:
        raise ValueError("no plane")
    normal, r = fit_plane(points[best])
    return (np.array(normal), r), best


def singular_values(points, threshold, iterations, rng):
    best = None
    for _ in range(iterations):
        sample = points[rng.choice(np.arange(len(points)), size=3, replace=False)]
        center = sample.mean(axis=0)
        _, values, directions = np.linalg.svd(sample - center)
        if values[1] < 1e-9 * max(values[0], 1e-9):
            continue
        inliers = np.where(((points - center) @ directions[2]) ** 2 <= threshold**2)[0]
        if best is None or inliers.size > best.size:
            best = inliers
    if best is None:
        raise ValueError("no plane")
    center = points[best].mean(axis=0)
    normal = np.linalg.svd(points[best] - center)[2][2]  # its sign is left to chance
    return (normal, float(normal @ center)), best
