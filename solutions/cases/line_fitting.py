"""Inputs and comparisons for `fit_line` and `line_covariance`."""

import math

import numpy as np

from solutions.cases.case import Case, Value, real, real_numbers
from solutions.lines.line_fitting import fit_line, line_covariance, positions_along


def fit_line_cases(rng: np.random.Generator) -> list[Case]:
    """Return walls that together tell every known mistake from the reference."""
    tilt = rng.uniform(0.3, 0.6)  # rad, keeps sloping walls away from both axes
    cases: list[Case] = [
        {
            "name": "three points of 3x + 4y = 10",  # r = 2, alpha = atan(4/3)
            "args": [np.array([[-2.0, 4.0], [2.0, 1.0], [6.0, -2.0]])],
            "public": True,
        },
        {
            "name": "a vertical wall",
            "args": [np.array([[2.0, -1.0], [2.1, 0.0], [1.9, 1.0], [2.0, 2.0]])],
            "public": True,
        },
        # Walls on all sides: about half of them have a normal that must be turned round.
        *(
            {"name": f"a sloping wall, {side}", "args": [_wall(rng, 3.0, turn + tilt)]}
            for side, turn in (
                ("ahead", 0.0),
                ("on the left", math.pi / 2),
                ("behind", math.pi),
                ("on the right", -math.pi / 2),
            )
        ),
        {"name": "a wall behind, to the right", "args": [_wall(rng, 3.0, -math.pi + tilt)]},
        {"name": "a wall behind, to the left", "args": [_wall(rng, 3.0, math.pi - tilt)]},
        {"name": "a vertical wall", "args": [_wall(rng, 4.0, 0.0)]},
        {"name": "a vertical wall", "args": [_wall(rng, 4.0, math.pi)]},
        {"name": "a horizontal wall", "args": [_wall(rng, 4.0, math.pi / 2)]},
        {"name": "a horizontal wall", "args": [_wall(rng, 4.0, -math.pi / 2)]},
        # Nearer than a metre, on all sides.
        *(
            {"name": "a wall close to the origin", "args": [_wall(rng, r, turn + tilt)]}
            for r, turn in zip(rng.uniform(0.2, 0.8, 4), np.arange(4) * math.pi / 2, strict=True)
        ),
        {"name": "a short, rough wall", "args": [_wall(rng, 2.0, tilt, length=0.5, noise=0.1)]},
        {"name": "a wall through the origin", "args": [_wall(rng, 0.0, tilt)]},
    ]
    far = rng.uniform(0.8e6, 1.2e6, (3, 2)) * rng.choice([-1.0, 1.0], (3, 2))
    cases += [
        {"name": "a wall far from the origin (1000 km)", "args": [_wall(rng, 3.0, tilt) + offset]}
        for offset in far
    ]
    for turn in (0.0, 2.0):
        wall = _wall(rng, 3.0, turn + tilt)
        weights = rng.uniform(0.1, 1.0, len(wall))
        wall[::3] += 0.5  # the points that count least are off
        weights[::3] *= 0.1
        cases.append({"name": "weighted points", "args": [wall, weights]})
    # Counted twice, and not at all: only the ratio of weights matters.
    wall = _wall(rng, 3.0, tilt - 1.0, count=6)
    cases.append({"name": "weighted points", "args": [wall, np.array([20.0, 10, 0, 10, 10, 10])]})
    # A point that does not count may lie anywhere.
    wall = wall.copy()
    wall[2] += rng.uniform(4.0, 6.0, 2)
    cases.append({"name": "weighted points", "args": [wall, np.array([3.0, 1, 0, 2, 1, 1])]})
    cases.append({"name": "two points", "args": [rng.uniform(1.0, 4.0, (2, 2))]})
    cases += _exact_walls(rng)
    # All points count, also equal ones and one that does not seem to belong to the others.
    wall = _wall(rng, 3.0, tilt + 1.0)
    cases += [
        {"name": "points that occur twice", "args": [np.vstack([wall, wall[:9], wall[:3]])]},
        {"name": "a wall and one point far off", "args": [np.vstack([wall, [[9.0, 7.0]]])]},
    ]
    # Whole numbers, four of them: sums and means are exact, and so is what they say.
    spot = rng.integers(-9, 9, 2).astype(float)
    aside = spot + 40.0  # farther from the origin than they are wide
    corners = aside + rng.integers(1, 5) * np.array([[1.0, 1], [1, -1], [-1, 1], [-1, -1]])
    turned = aside + rng.integers(1, 5) * np.array([[2.0, 1], [-1, 2], [-2, -1], [1, -2]])
    cases += [
        {"name": "fewer than two different points", "args": [np.tile(spot, (4, 1))]},
        {"name": "fewer than two different points", "args": [np.tile(spot, (2, 1))]},
        {"name": "fewer than two different points", "args": [spot[None]]},
        {"name": "the corners of a square", "args": [corners]},
        {"name": "the corners of a square", "args": [turned]},
    ]
    return cases


def _exact_walls(rng: np.random.Generator) -> list[Case]:
    """Return walls without noise, some of them exactly upright or halfway between the axes.

    None is exactly level: rounding decides there to which side a normal points that is not turned,
    and so whether such a mistake is seen.
    """
    steps = rng.permutation([0.0, 1.0, 2.0, 5.0])[:, None]
    across = {"vertical": [1.0, 0.0], "diagonal": [1.0, -1.0]}
    cases: list[Case] = []
    for kind, normal in across.items():
        for side in (-1, 1):
            foot = side * rng.integers(2, 6) * np.array(normal)
            points = foot + steps * [normal[1], normal[0]] * [1, -1 if kind == "diagonal" else 1]
            cases.append({"name": f"an exactly {kind} wall", "args": [points]})
    # Hardly higher than wide, and hardly longer than a millimetre.
    spread = rng.integers(2, 5) * np.array([[0.998, 0], [-0.998, 0], [0, 1.0], [0, -1.0]])
    cases.append({"name": "a cloud that is nearly round", "args": [spread + np.array([3.0, 2.0])]})
    place = rng.uniform(1.0, 3.0, 2)
    tiny = place + np.array([[0.0, 0.0], [8e-4, 6e-4], [4e-4, 3e-4]])
    cases.append({"name": "a wall of a millimetre", "args": [tiny]})
    cases += [
        {
            "name": "a wall close to the origin",
            "args": [_wall(rng, 0.004, turn + 0.4, noise=0.0, count=9)],
        }
        for turn in np.arange(4) * math.pi / 2
    ]
    direction = np.array([[3.0, 4.0]]) if rng.random() < 0.5 else np.array([[-5.0, 12.0]])
    cases.append({"name": "a wall through the origin", "args": [(steps - 1) * direction]})
    return cases


def same_line(case: Case, expected: Value, actual: Value) -> bool:
    """Tell whether `actual` is the line `expected`, to 1e-6 rad and 1e-6 of the points' reach.

    Both numbers are compared as they are, so a negative r or an alpha outside (-pi, pi] does
    not pass for its equal inside. Only what rounding may decide is forgiven: pi for -pi, and
    the side that the normal of a line through the origin points to.
    """
    points = np.asarray(case["args"][0], dtype=float)
    if len(points) == 1 or not _one_line_is_the_best(points):
        return True  # the reference raises: one line is as wrong as another
    try:
        r, alpha = (real(value) for value in actual)
    except (TypeError, ValueError, OverflowError):
        return False
    if not (math.isfinite(r) and math.isfinite(alpha)):
        return False
    tolerance = 1e-6
    reach = max(1.0, float(np.abs(points).max()))
    turn = alpha - expected[1]
    ends_of_range = max(abs(alpha), abs(expected[1])) <= math.pi + tolerance
    through_origin = max(abs(r), abs(expected[0])) <= tolerance
    if ends_of_range and through_origin:
        turn = math.remainder(turn, math.pi)
    elif ends_of_range and abs(turn) > 2 * (math.pi - tolerance):
        turn = math.remainder(turn, 2 * math.pi)
    return abs(turn) <= tolerance and abs(r - expected[0]) <= tolerance * reach


def _one_line_is_the_best(points: np.ndarray) -> bool:
    wide, narrow = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    return bool(wide - narrow > 1e-9 * max(1.0, np.abs(points).max()))


def line_covariance_cases(rng: np.random.Generator) -> list[Case]:
    """Return walls with the standard deviation of their points."""
    corner = np.array([[2.0, 1.0], [2.0, 2.0], [2.0, 3.0]])
    cases: list[Case] = [
        {"name": "three points of x = 2", "args": [corner, 0.1], "public": True},
    ]
    for name, along, sigma, length, count, noise in (
        ("a wall to the left of its normal", 4.0, 0.02, 6.0, 40, 1e-4),
        ("a wall to the right of its normal", -4.0, 0.02, 6.0, 40, 1e-4),
        ("a wall to the left of its normal", 2.0, 0.05, 6.0, 40, 1e-4),
        ("a few points", 1.0, 0.001, 1.0, 4, 1e-4),
        ("a few points", -60.0, 0.3, 80.0, 5, 1e-4),
        ("a few points", 60.0, 0.3, 80.0, 5, 1e-4),
        ("centred on the foot of the normal", 0.0, 0.02, 6.0, 7, 1e-4),
        ("many points", 2.0, 0.02, 6.0, 300, 1e-4),
        # So wide that the spread across the wall cannot pass for a part of that along it.
        ("a rough wall", 2.0, 0.05, 6.0, 40, 0.06),
    ):
        alpha = rng.uniform(-3.0, 3.0)
        wall = _wall(rng, length * rng.uniform(0.4, 0.8), alpha, length, noise * length, count)
        # More points at one end than at the other: their mean is not their median.
        direction = np.array([-math.sin(alpha), math.cos(alpha)])
        wall += np.outer(along + 0.2 * length * np.linspace(-1, 1, count) ** 2, direction)
        cases.append({"name": name, "args": [wall, sigma * rng.uniform(0.7, 1.3)]})
    # Ten centimetres long, and its centre three beside the foot of the normal.
    direction = np.array([-math.sin(alpha), math.cos(alpha)])
    short = _wall(rng, 1.0, alpha, 0.1, 1e-5, 12)
    short += (0.03 - direction @ short.mean(axis=0)) * direction
    cases.append({"name": "a short wall, nearly at the foot", "args": [short, 2e-4]})
    return cases


def same_covariance(case: Case, expected: Value, actual: object) -> bool:
    """Tell whether two (2, 2) covariances agree to a thousandth of the deviations.

    The reference counts the scatter across the wall, which the question's formula leaves out. On a
    rough wall they differ by some per cent, and either is right.
    """
    try:
        values = real_numbers(actual)
    except (TypeError, ValueError, OverflowError):
        return False
    if values.shape != (2, 2) or not np.isfinite(values).all():
        return False
    right = [expected]
    if case["args"] and np.allclose(expected, line_covariance(*case["args"]), rtol=1e-9, atol=0):
        right.append(_to_first_order(*case["args"]))
    return any(
        (np.abs(values - one) <= 1e-3 * np.sqrt(np.abs(np.outer(np.diag(one), np.diag(one))))).all()
        for one in right
    )


def _to_first_order(points: np.ndarray, sigma: float) -> np.ndarray:
    """Return the covariance by the formula that the question gives."""
    positions = positions_along(points, fit_line(points))
    N, t = len(points), positions.mean()
    B = np.sum((positions - t) ** 2)
    return sigma**2 * np.array([[1 / N + t**2 / B, t / B], [t / B, 1 / B]])


def _wall(
    rng: np.random.Generator,
    r: float,
    alpha: float,
    length: float = 6.0,
    noise: float = 0.02,
    count: int = 40,
) -> np.ndarray:
    """Return (count, 2) points along a wall whose normal points in the direction alpha."""
    normal = np.array([math.cos(alpha), math.sin(alpha)])
    along = np.array([-normal[1], normal[0]])
    positions = np.linspace(-0.5, 0.5, count) * length + rng.uniform(-1.0, 1.0)
    offsets = r + rng.normal(0.0, noise, count)
    return np.outer(offsets, normal) + np.outer(positions, along)
