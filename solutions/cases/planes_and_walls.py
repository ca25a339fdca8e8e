"""Inputs and comparisons for `ransac_plane` and `find_walls`.

As in `solutions.cases.ransac`, noise is bounded well within the threshold and everything else keeps
away from it, so that a right implementation finds the same consensus whatever it draws.
"""

import math
from typing import Any

import numpy as np

Case = dict[str, Any]
THRESHOLD = 0.05  # m


def ransac_plane_cases(rng: np.random.Generator) -> list[Case]:
    """Return planes of different sizes and directions among outliers."""
    fixed = np.random.default_rng(4)
    return [
        {**_plane(fixed, "a floor and a few outliers", (0.0, 0.0, 1.0), 0.2), "public": True},
        _plane(rng, "a floor, half outliers", (0.0, 0.0, 1.0), 0.5),
        _plane(rng, "a wall, half outliers", (1.0, 0.0, 0.0), 0.5),
        _plane(rng, "a slope", tuple(rng.uniform(0.3, 1.0, 3)), 0.4),
        _plane(rng, "a slope that faces back", tuple(-rng.uniform(0.3, 1.0, 3)), 0.4),
        _plane(rng, "a large plane", tuple(rng.uniform(0.3, 1.0, 3)), 0.4, size=8.0),
        _plane(rng, "outliers on one side only", tuple(rng.uniform(0.3, 1.0, 3)), 0.5),
    ]


def same_plane(case: Case, expected: Any, actual: Any) -> bool:
    """Tell whether plane and inliers agree; a plane may be given by either of its normals."""
    try:
        (normal, r), inliers = actual
        normal, r = np.asarray(normal, dtype=float), float(r)
        inliers = np.asarray(inliers)
    except (TypeError, ValueError, OverflowError):
        return False
    if normal.shape != (3,) or not (np.isfinite(normal).all() and math.isfinite(r)):
        return False
    (expected_normal, expected_r), expected_inliers = expected
    side = 1.0 if normal @ expected_normal >= 0 else -1.0
    points, threshold = np.asarray(case["args"][0]), case["args"][1]
    reach = float(np.abs(points).max())
    return bool(
        inliers.dtype.kind in "iu"
        and abs(side * r - expected_r) <= 0.1 * threshold
        and np.abs(side * normal - expected_normal).max() * reach <= 0.1 * threshold
        and np.array_equal(np.sort(inliers.ravel()), np.sort(expected_inliers))
    )


def find_walls_cases(rng: np.random.Generator) -> list[Case]:
    """Return rooms whose walls have different numbers of points and do not touch."""
    fixed = np.random.default_rng(2)
    return [
        {**_room(fixed, "a corridor", (40, 25)), "public": True},
        _room(rng, "a single wall", (40,)),
        _room(rng, "a corridor with its end", (50, 35, 24)),
        _room(rng, "four walls", (60, 44, 32, 22)),
        _room(rng, "two walls and people between them", (50, 30), clutter=20),
        _room(rng, "a room full of chairs", (60, 44, 32), clutter=30),
    ]


def same_walls(case: Case, expected: Any, actual: Any) -> bool:
    """Tell whether the same walls were found in the same order, which is that of their sizes."""
    try:
        walls = [
            (float(line[0]), float(line[1]), np.sort(np.asarray(indices).ravel()))
            for line, indices in actual
        ]
    except (TypeError, ValueError, OverflowError, IndexError):
        return False
    if len(walls) != len(expected):
        return False
    threshold = case["args"][1]
    for (r, alpha, indices), (line, expected_indices) in zip(walls, expected, strict=True):
        if not (abs(r) < 1e6 and abs(alpha) <= 2 * math.pi):
            return False
        turn = math.remainder(alpha - line[1], 2 * math.pi)
        if abs(r - line[0]) > 0.2 * threshold or abs(turn) > 0.2 * threshold:
            return False
        if not np.array_equal(indices, np.sort(expected_indices)):
            return False
    return True


def _plane(
    rng: np.random.Generator,
    name: str,
    direction: tuple[float, ...],
    outlier_share: float,
    size: float = 4.0,
) -> Case:
    """Return a case: 80 points of a square plane and the outliers, in random order."""
    normal = np.asarray(direction) / np.linalg.norm(direction)
    _, _, axes = np.linalg.svd(normal[None])  # rows 1 and 2 span the plane
    count, r = 80, rng.uniform(2.0, 3.0)
    noise = THRESHOLD * (rng.choice([-0.25, 0.25], count) + rng.normal(0, 0.02, count))
    number = round(count * outlier_share / (1 - outlier_share))
    away = rng.uniform(10 * THRESHOLD, 3.0, number)
    if "one side" not in name:
        away *= rng.choice([-1.0, 1.0], number)
    offsets = np.concatenate([r + noise, r + away])
    in_plane = rng.uniform(-size / 2, size / 2, (count + number, 2))
    points = rng.permutation(np.outer(offsets, normal) + in_plane @ axes[1:])
    return {"name": name, "args": [points, THRESHOLD, 400, {"rng": int(rng.integers(2**31))}]}


def _room(rng: np.random.Generator, name: str, counts: tuple[int, ...], clutter: int = 0) -> Case:
    """Return a case: walls a quarter turn from each other, each with so many points.

    The clutter is far from all walls and too irregular for a line of 15 points.
    """
    tilt = rng.uniform(-0.4, 0.4)
    walls = []
    for turn, count in enumerate(counts):
        alpha = tilt + turn * math.pi / 2
        normal = np.array([math.cos(alpha), math.sin(alpha)])
        along = np.array([-normal[1], normal[0]])
        noise = THRESHOLD * (rng.choice([-0.25, 0.25], count) + rng.normal(0, 0.02, count))
        # Two metres long at three metres' distance: no wall crosses the line of another.
        positions = np.linspace(-1.0, 1.0, count)
        walls.append(np.outer(3.0 + noise, normal) + np.outer(positions, along))
    walls.append(rng.uniform(-1.6, 1.6, (clutter, 2)))
    points = rng.permutation(np.vstack(walls))
    return {
        "name": name,
        "args": [points, THRESHOLD, 400, 15, {"rng": int(rng.integers(2**31))}],
    }
