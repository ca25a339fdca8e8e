"""Hard simulated scans: straight walls, and much that is not.

Rooms with partitions; curved walls and pillars; people, as pairs of legs; bushes, in which
the beam ends anywhere; mixed pixels between near and far; noise, rounding, lost echoes.
"""

import math
from dataclasses import dataclass

import numpy as np

BEAMS = np.radians(np.arange(-90.0, 90.0))  # as the SICK scanner of Killian Court
NO_ECHO = 50.0  # m


@dataclass(frozen=True)
class Scene:
    """One scan and the straight walls it sees."""

    ranges: np.ndarray  # (B,) m
    walls: np.ndarray  # (K, 2, 2) m, end points of all straight walls, in the scanner's frame
    visible: np.ndarray  # (K,) whether the scan shows enough of a wall to ask for it


def hard_scenes(count: int, rng: np.random.Generator) -> list[Scene]:
    """Scenes, `count` of them, each in a world of its own."""
    return [hard_scene(rng) for _ in range(count)]


def hard_scene(rng: np.random.Generator, sigma: float = 0.015) -> Scene:
    """One scan from a random place in a random room."""
    half = rng.uniform([4.0, 3.0], [9.0, 7.0])
    walls = np.concatenate([_room(half), _partitions(rng, half)])
    circles, arcs, bushes = _round_things(rng, half)

    position, heading = rng.uniform(-0.6, 0.6, 2) * half, rng.uniform(-math.pi, math.pi)
    turn = np.array(
        [[math.cos(heading), math.sin(heading)], [-math.sin(heading), math.cos(heading)]]
    )
    walls = (walls - position) @ turn.T
    circles[:, :2] = (circles[:, :2] - position) @ turn.T
    bushes[:, :2] = (bushes[:, :2] - position) @ turn.T
    circles = circles[np.hypot(circles[:, 0], circles[:, 1]) > circles[:, 2] + 0.3]
    bushes = bushes[np.hypot(bushes[:, 0], bushes[:, 1]) > bushes[:, 2] + 0.3]
    arcs[:, :2] = (arcs[:, :2] - position) @ turn.T
    arcs[:, 3] -= heading

    hits = np.concatenate(
        [
            _ray_walls(walls),
            _ray_circles(circles)[0],
            _ray_arcs(arcs),
            _ray_bushes(bushes, rng),
        ],
        axis=1,
    )
    nearest = hits.argmin(axis=1)
    ranges = hits[np.arange(len(BEAMS)), nearest]
    on_wall = np.where(np.isfinite(ranges) & (nearest < len(walls)), nearest, -1)

    ranges = ranges + rng.normal(0.0, sigma, len(ranges))
    jumps = np.flatnonzero(np.abs(np.diff(ranges)) > 0.3)
    mixed = jumps[rng.uniform(size=len(jumps)) < 0.5]
    share = rng.uniform(size=len(mixed))
    ranges[mixed] = share * ranges[mixed] + (1 - share) * ranges[mixed + 1]
    ranges = np.round(ranges, 2)
    lost = (rng.uniform(size=len(ranges)) < 0.015) | ~np.isfinite(ranges)
    ranges[lost] = NO_ECHO
    on_wall[mixed], on_wall[lost] = -1, -1

    points = ranges[:, None] * np.column_stack([np.cos(BEAMS), np.sin(BEAMS)])
    visible = np.array([_is_visible(points[on_wall == wall]) for wall in range(len(walls))])
    return Scene(ranges, walls, visible)


def _is_visible(points: np.ndarray, min_points: int = 12, min_length: float = 0.6) -> bool:
    return len(points) >= min_points and np.hypot(*(points[-1] - points[0])) >= min_length


def _room(half: np.ndarray) -> np.ndarray:
    corners = half * [[-1, -1], [1, -1], [1, 1], [-1, 1]]
    return np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)


def _partitions(rng: np.random.Generator, half: np.ndarray) -> np.ndarray:
    """Free-standing walls of 1 to 4 m in any direction."""
    count = rng.integers(1, 5)
    center = rng.uniform(-0.9, 0.9, (count, 2)) * half
    angle = rng.uniform(0, math.pi, count)
    reach = np.column_stack([np.cos(angle), np.sin(angle)]) * rng.uniform(0.5, 2.0, (count, 1))
    return np.stack([center - reach, center + reach], axis=1)


def _round_things(
    rng: np.random.Generator, half: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Circles (x, y, radius), arcs (x, y, radius, middle, half opening), bushes."""

    def places(count: int) -> np.ndarray:
        return rng.uniform(-0.9, 0.9, (count, 2)) * half

    pillars = np.column_stack([places(3), rng.uniform(0.15, 0.5, 3)])
    people = places(int(rng.integers(2, 7)))
    stride = rng.uniform(-0.25, 0.25, people.shape)
    legs = np.column_stack(
        [np.concatenate([people, people + stride]), rng.uniform(0.06, 0.1, 2 * len(people))]
    )
    count = int(rng.integers(1, 4))
    arcs = np.column_stack(
        [
            places(count),
            rng.uniform(1.0, 5.0, count),
            rng.uniform(-math.pi, math.pi, count),
            rng.uniform(0.2, 0.8, count),
        ]
    )
    bushes = np.column_stack([places(3), rng.uniform(0.4, 1.2, 3)])
    return np.concatenate([pillars, legs]), arcs, bushes


def _ray_walls(walls: np.ndarray) -> np.ndarray:
    """(B, K) distances along the beams, infinite where a wall is missed."""
    direction = np.column_stack([np.cos(BEAMS), np.sin(BEAMS)])[:, None]
    start, along = walls[:, 0], walls[:, 1] - walls[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        across = _cross(direction, along)
        distance = _cross(start, along) / across
        share = _cross(start, direction) / across
    return np.where((distance > 0.05) & (share >= 0) & (share <= 1), distance, np.inf)


def _ray_circles(circles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(B, C) distances to the near and the far side of circles."""
    x, y, radius = circles[:, :3].T
    forward = np.outer(np.cos(BEAMS), x) + np.outer(np.sin(BEAMS), y)
    inside = radius**2 - (x * x + y * y - forward**2)
    root = np.sqrt(np.where(inside > 0, inside, np.nan))
    near, far = forward - root, forward + root
    return tuple(np.where(side > 0.05, side, np.inf) for side in (near, far))  # type: ignore[return-value]


def _ray_arcs(arcs: np.ndarray) -> np.ndarray:
    best = np.full((len(BEAMS), len(arcs)), np.inf)
    for distance in _ray_circles(arcs):
        finite = np.where(np.isfinite(distance), distance, 0.0)
        x = finite * np.cos(BEAMS)[:, None] - arcs[:, 0]
        y = finite * np.sin(BEAMS)[:, None] - arcs[:, 1]
        turn = np.angle(np.exp(1j * (np.arctan2(y, x) - arcs[:, 3])))
        best = np.minimum(best, np.where(np.abs(turn) < arcs[:, 4], distance, np.inf))
    return best


def _ray_bushes(bushes: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """A beam ends anywhere inside a bush, or passes through."""
    near, far = _ray_circles(bushes)
    near, far = np.where(np.isfinite(near), near, 0.0), np.where(np.isfinite(far), far, 0.0)
    depth = near + rng.uniform(size=near.shape) * (far - near)
    return np.where((depth > 0.05) & (rng.uniform(size=near.shape) < 0.8), depth, np.inf)


def _cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
