"""Inputs and comparisons for `ransac_plane` and `find_walls`.

As in `solutions.cases.consensus`, there is one largest consensus set, and a right implementation
finds it whatever it draws.
"""

import math

import numpy as np

from solutions.cases.case import Case, Value, real, real_numbers, seed_of
from solutions.cases.consensus import (
    EXACT,
    INSIDE,
    LENIENT,
    STRICT,
    across_the_wall,
    axes_of,
    evenly_mixed,
    far_away,
    outliers_first,
)
from solutions.cases.many_walls import many_walls, wall_in_a_crowd
from solutions.cases.ransac import exact_wall, overlap
from solutions.cases.rough_and_smooth import rough_and_smooth_plane


def ransac_plane_cases(rng: np.random.Generator) -> list[Case]:
    """Return planes of different sizes and directions among outliers."""
    small, large = (0.012, 0.02), (0.3, 0.4)
    slope, back = tuple(rng.uniform(0.3, 1.0, 3)), tuple(-rng.uniform(0.3, 1.0, 3))
    floor, wall = (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)
    public = _plane(np.random.default_rng(4), "a floor and a few outliers", floor, 0.05, 4.0)
    cases = [
        _plane(rng, "a floor", floor, small, 1.0, iterations=75),
        _plane(
            rng,
            "a large wall, many outliers",
            wall,
            large,
            20.0,
            far=25,
            iterations=140,
            mixed=True,
        ),
        _plane(rng, "a slope", slope, large, 20.0, iterations=80),
        _plane(rng, "a slope that faces back", back, small, 1.0, iterations=85),
        _plane(rng, "outliers on one side only", slope, small, 1.0, sides=1, iterations=70),
        _plane(rng, "many points in one spot", back, small, 1.0, far=0, spot=20, iterations=120),
    ]
    cases.append(
        _plane(
            rng,
            "two thirds are outliers, and come first",
            slope,
            small,
            1.0,
            far=110,
            iterations=760,
            crowd=True,
        )
    )
    cases += [
        rough_and_smooth_plane(rng, small, 1.0),
        rough_and_smooth_plane(rng, large, 20.0),
    ]
    # Multiples of three: the mean of three points is exact, and so is a cross product of zero.
    on_a_line = np.outer(3.0 * rng.permutation(12), rng.integers(1, 4, 3))
    beside = np.cross(on_a_line.max(axis=0), [1, 2, -4])[None] + on_a_line[:1]
    cloud, threshold = cases[0]["args"][:2]
    # Whole numbers again: any three of these points are on one plane with the origin, exactly.
    one, other = rng.permutation([[2.0, 1.0, 3.0], [-1.0, 4.0, 2.0], [3.0, -2.0, 5.0]])[:2]
    through_origin = np.array([[1, 0], [0, 1], [2, 1], [1, 3], [-1, 2]]) @ [one, other]
    cases += [
        # Nearer to each other than the threshold, and a plane all the same.
        {"name": "three points", "args": [_exact_plane(rng, 0.1)[:3], 0.3, 3, seed_of(rng)]},
        # A sample of three different points is a plane the first time, whatever is drawn.
        *(
            {"name": "three points", "args": [_exact_plane(rng)[:3], 0.1, 1, seed_of(rng)]}
            for _ in range(6)
        ),
        # A plane is found only by a sample that holds the point elsewhere.
        *(
            {
                "name": name,
                "args": [np.vstack(parts), 0.05, 80, seed_of(rng)],
                "draws": (80, math.inf),
            }
            for name, parts in (
                ("all points but the last on one line", [on_a_line, beside]),
                ("all points but the first on one line", [beside, on_a_line]),
            )
        ),
        {"name": "a plane through the origin", "args": [through_origin, 0.05, 9, seed_of(rng)]},
        # Three centimetres wide: small triangles are triangles, too.
        {"name": "a small plane", "args": [_exact_plane(rng, 0.015), 4e-4, 4, seed_of(rng)]},
        {
            "name": "no outliers, one iteration",
            "args": [_exact_plane(rng), threshold, 1, seed_of(rng)],
            "draws": (1, 30),
            "samples": (3, 1, 1),
        },
        {
            "name": "no outliers, thirty iterations",
            "args": [_exact_plane(rng), threshold, 30, seed_of(rng)],
            "draws": (30, 30 * 30),  # a sample may be the head of a permutation
            "samples": (3, 30, 30),
        },
        {"name": "no iterations", "args": [cloud, threshold, 0, seed_of(rng)]},
        {
            "name": "all points on one line",
            "args": [on_a_line, threshold, 8, seed_of(rng)],
        },
    ]
    return [{**public, "public": True}, *cases]


def same_plane(case: Case, expected: Value, actual: Value) -> bool:
    """Tell whether plane and inliers agree; a plane may be given by either of its normals.

    As with `solutions.cases.ransac.same_consensus`, mistakes are compared loosely.
    """
    points, threshold, iterations = case["args"][:3]
    if iterations == 0 or np.linalg.matrix_rank(points - points[0]) < 2:
        return True  # no plane, and the reference raises: one value is as wrong as another
    try:
        (normal, r), inliers = actual
        normal, r = real_numbers(normal), real(r)
        inliers = np.asarray(inliers)
    except (TypeError, ValueError, OverflowError):
        return False
    if normal.shape != (3,) or not (np.isfinite(normal).all() and math.isfinite(r)):
        return False
    if inliers.dtype.kind not in "iu" and inliers.size:
        return False
    (expected_normal, expected_r), expected_inliers = expected
    offsets = np.abs(points @ expected_normal - expected_r)
    sound = np.array_equal(np.flatnonzero(offsets <= threshold), np.sort(expected_inliers))
    side = 1.0 if normal @ expected_normal >= 0 else -1.0
    turn = np.abs(side * normal - expected_normal).max() * np.abs(points).max()
    off = max(abs(side * r - expected_r), turn) / threshold
    if sound:
        return bool(
            off <= 0.01 and np.array_equal(np.sort(inliers.ravel()), np.sort(expected_inliers))
        )
    return bool(off <= 3.0 and overlap(inliers, expected_inliers) >= 0.9)


def find_walls_cases(rng: np.random.Generator) -> list[Case]:
    """Return rooms whose walls have different numbers of points."""
    few = int(rng.integers(21, 26))  # the smallest wall that is one
    small, large = (0.012, 0.02), (0.3, 0.4)
    public = _room(np.random.default_rng(2), "a corridor", (40, 25), 15, 0.05, 2.0)
    cases = [
        _room(rng, "a corridor with its end", (60, 46, 34), 25, small, 1.0, iterations=160),
        _room(rng, "a large room", (60, 48, 22), 30, large, 20.0, iterations=135),
        _room(rng, "all four walls of a room", (72, 52, 38, 26), 20, small, 1.0, iterations=200),
        _room(rng, "a wall with just enough points", (50, few), few, small, 1.0, iterations=65),
        _room(rng, "a wall with one point too few", (60, few + 12, few - 1), few, large, 20.0),
        _room(
            rng,
            "walls whose lines cross at a point",
            (56, 36),
            12,
            small,
            1.0,
            corner=3,
            iterations=80,
        ),
        _room(
            rng, "people between two walls", (60, 40), 22, small, 1.0, clutter=16, iterations=100
        ),
        _room(rng, "nothing but people", (), 12, small, 1.0, clutter=14, iterations=70),
    ]
    cases += [_crossing_walls(rng), many_walls(rng), wall_in_a_crowd(rng)]
    wall = exact_wall(rng)
    threshold = cases[0]["args"][1]
    along = (wall[1] - wall[0]) / np.linalg.norm(wall[1] - wall[0])
    across = np.array([-along[1], along[0]])
    # Beside the wall, and at any threshold here too far from each other to agree with anything.
    pair = np.mean(wall, axis=0) + np.array([3 * across + along, 5 * across - along])
    spot = np.tile(rng.uniform(-1.0, 1.0, 2), (9, 1))
    cases += [
        {
            "name": "one wall and nothing else",
            "args": [wall, threshold, 1, len(wall), seed_of(rng)],
            "draws": (1, 4 * len(wall)),
            "samples": (2, 1, 1),
        },
        {
            "name": "one wall and one more point",
            "args": [np.vstack([wall, pair[:1]]), threshold, 12, len(wall), seed_of(rng)],
            "draws": (12, math.inf),
            "samples": (2, 12, 12),
        },
        {
            "name": "walls of two points",
            "args": [np.vstack([pair, wall]), threshold, 25, 2, seed_of(rng)],
            "draws": (25, math.inf),
            "samples": (2, 2 * 25, 2 * 25),
        },
        # No sample of what is left gives a line. That `ransac_line` raises then need not be caught.
        {
            "name": "the rest in one spot",
            "args": [np.vstack([wall, spot]), threshold, 60, len(spot), seed_of(rng)],
            "draws": (60, math.inf),
            "may_raise": "ValueError",
        },
        {
            "name": "no iterations",
            "args": [wall, threshold, 0, len(wall), seed_of(rng)],
            "may_raise": "ValueError",
        },
    ]
    return [{**public, "public": True}, *cases]


def same_walls(case: Case, expected: Value, actual: Value) -> bool:
    """Tell whether the same walls were found in the same order, which is that of their sizes."""
    try:
        walls = [
            (real(line[0]), real(line[1]), np.sort(np.asarray(indices).ravel()))
            for line, indices in actual
        ]
    except (TypeError, ValueError, OverflowError, IndexError):
        return False
    if len(walls) != len(expected):
        return False
    points, threshold = np.asarray(case["args"][0]), case["args"][1]
    size = float(np.ptp(points, axis=0).max()) / 2
    for (r, alpha, indices), (line, expected_indices) in zip(walls, expected, strict=True):
        if not (abs(r) < 1e6 and abs(alpha) <= 2 * math.pi):
            return False
        turn = math.remainder(alpha - line[1], 2 * math.pi)
        if abs(r - line[0]) > 0.2 * threshold or abs(turn) * size > 0.4 * threshold:
            return False
        if not np.array_equal(indices, np.sort(expected_indices)):
            return False
    return True


def _plane(
    rng: np.random.Generator,
    name: str,
    direction: tuple[float, ...],
    threshold: float | tuple[float, float],
    scale: float,
    *,
    far: int = 10,
    sides: int = 2,
    spot: int = 0,
    iterations: int = 110,
    mixed: bool = False,
    crowd: bool = False,
) -> Case:
    """Return a case: 56 points of a square plane, 4 times the scale, and outliers.

    They are shuffled, or evenly mixed, or a crowd of outliers comes first.
    """
    if isinstance(threshold, tuple):
        threshold = float(rng.uniform(*threshold))
    normal = np.asarray(direction) / np.linalg.norm(direction)
    axes = np.linalg.svd(normal[None])[2][1:]  # the two rows span the plane
    count, r = 50, rng.uniform(2.0, 3.0) * scale
    bulk, middle = across_the_wall(rng, threshold, count, EXACT if crowd else STRICT, sides)
    others = far_away(rng, threshold, max(3.0 * scale, 30 * threshold), far, sides)
    in_plane = np.vstack(
        [
            rng.uniform(-2, 2, (count, 2)),
            rng.uniform(-0.02, 0.02, (len(middle), 2)),
            rng.uniform(-2, 2, (far, 2)),
        ]
    )
    points = np.outer(r + np.concatenate([bulk, middle, others]), normal) + scale * in_plane @ axes
    spots = np.tile((r + 1.5 * scale) * normal + scale * axes[0], (spot, 1))
    points, on_it = np.vstack([points, spots]), count + 2 * INSIDE
    if crowd:
        points = outliers_first(rng, points[:on_it], points[on_it:])
    else:
        points = evenly_mixed(points[:on_it], points[on_it:]) if mixed else rng.permutation(points)
    return {
        "name": name,
        "args": [points, threshold, iterations, seed_of(rng)],
        "draws": (iterations, math.inf),
        # In place of three equal points, or three on one line, one may draw again.
        "samples": (3, iterations, math.inf if spot else iterations),
    }


def _exact_plane(rng: np.random.Generator, radius: float = 1.0) -> np.ndarray:
    """Return 6 points of a circle, exactly on a plane, no three of them near one line."""
    turn = np.arange(6) * math.pi / 3 + rng.uniform(0, math.pi)
    tilt = axes_of(rng.uniform(-3.0, 3.0))
    flat = np.column_stack([np.full(6, rng.uniform(2.0, 3.0)), radius * np.cos(turn)])
    return rng.permutation(np.column_stack([flat @ tilt, radius * np.sin(turn)]))


def _room(
    rng: np.random.Generator,
    name: str,
    counts: tuple[int, ...],
    min_points: int,
    threshold: float | tuple[float, float],
    scale: float,
    *,
    clutter: int = 0,
    corner: int = 0,
    iterations: int = 120,
) -> Case:
    """Return a case: walls a quarter turn from each other, each with so many points.

    The clutter keeps away from all walls and is too irregular for a line of `min_points`.
    The `corner` points lie where the lines of the first two walls cross.
    """
    if isinstance(threshold, tuple):
        threshold = float(rng.uniform(*threshold))
    tilt, distance = rng.uniform(-0.4, 0.4), 3.0 * scale
    parts = [scale * rng.uniform(-1.6, 1.6, (clutter, 2))]
    for turn, count in enumerate(counts):
        on_it = count - 2 * INSIDE - (corner if turn == 0 else 0)
        bulk, middle = across_the_wall(rng, threshold, on_it, LENIENT)
        # Two metres long at three metres' distance: no wall crosses the line of another.
        positions = np.concatenate(
            [np.linspace(-1, 1, on_it), rng.uniform(-0.005, 0.005, len(middle))]
        )
        wall = np.column_stack([distance + np.concatenate([bulk, middle]), scale * positions])
        parts.append(wall @ axes_of(tilt + turn * math.pi / 2))
    if corner:
        near = distance + 0.05 * threshold * rng.uniform(-1, 1, (corner, 2))
        parts.append(near @ axes_of(tilt))
    points = rng.permutation(np.vstack(parts))
    walls = [count for count in counts if count >= min_points]
    left = len(points) - sum(walls)
    return {
        "name": name,
        "args": [points, threshold, iterations, min_points, seed_of(rng)],
        "draws": (iterations * max(1, len(counts)), math.inf),
        # Whether one searches among fewer points than a wall has makes no difference.
        "samples": (
            2,
            iterations * (len(walls) + (left >= min_points)),
            iterations * (len(walls) + (left >= 2)),
        ),
    }


def _crossing_walls(rng: np.random.Generator) -> Case:
    """Return a case: two walls that cross, exactly along the axes.

    The first takes one point of the second. The two points just beyond its band are needed for
    the second to have enough. Many points have the same x or the same y, so none can be known by
    one of them.
    """
    threshold, crossing, iterations = 0.25, 8.0 * rng.integers(-1, 2), 30
    first = np.column_stack([np.arange(-12.0, 13.0), np.zeros(25)])
    away = threshold * np.array([1.25, 12.0, 20.0, 28.0])  # exact in float32 as well
    second = np.concatenate([-away, [0.0], away])
    second = np.column_stack([np.full(len(second), crossing), second])
    second = second[second[:, 1] != 0]  # the first has a point there
    points = rng.permutation(np.vstack([first, second])) + rng.integers(15, 25, 2)
    return {
        "name": "walls that cross",
        "args": [points[:, rng.permutation(2)], threshold, iterations, len(second), seed_of(rng)],
        "draws": (2 * iterations, math.inf),
        "samples": (2, 2 * iterations, 2 * iterations),
    }
