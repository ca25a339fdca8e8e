"""A simulated corridor: a robot drives along known walls, past three people."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from data.making.archive import write_arrays

SEED = 6
BEAMS = 181
NOISE = 0.01  # m, standard deviation of a range
MAX_RANGE = 20.0  # m
NO_ECHO = 0.01  # share of the beams that come back empty
PERSON_RADIUS = 0.25  # m

# Each wall from (x0, y0) to (x1, y1), in m: two long sides with a door to a room, the room's walls,
# a pillar, and the far end of the corridor.
WALLS = np.array(
    [
        [-2.0, -1.2, 16.0, -1.2],
        [-2.0, 1.2, 6.0, 1.2],
        [8.0, 1.2, 16.0, 1.2],
        [6.0, 1.2, 6.0, 4.0],
        [8.0, 1.2, 8.0, 4.0],
        [6.0, 4.0, 8.0, 4.0],
        [11.0, -1.2, 11.0, -0.8],
        [11.0, -0.8, 11.6, -0.8],
        [11.6, -0.8, 11.6, -1.2],
        [16.0, -1.2, 16.0, 1.2],
        [-2.0, -1.2, -2.0, 1.2],
    ]
)
PEOPLE = np.array([[4.2, 0.4], [9.4, -0.3], [13.0, 0.6]])  # (x, y), they stand still


def make_corridor(target: Path) -> None:
    """Write ranges (60, 181) in m, angles, poses, the walls, and which wall each beam hit.

    A beam's wall is -1 if it hit a person or came back empty.
    """
    rng = np.random.default_rng(SEED)
    x = np.linspace(-1.0, 14.0, 60)
    poses = np.column_stack([x, 0.15 * np.sin(x), 0.15 * np.cos(x)])
    angles = np.linspace(-np.pi / 2, np.pi / 2, BEAMS)

    directions = poses[:, 2:] + angles
    distances = np.stack([_to_wall(poses, directions, wall) for wall in WALLS])
    hit = distances.argmin(axis=0)
    ranges = distances.min(axis=0)
    for person in PEOPLE:
        distance = _to_circle(poses, directions, person)
        hit = np.where(distance < ranges, -1, hit)
        ranges = np.minimum(ranges, distance)
    ranges = ranges + rng.normal(0.0, NOISE, ranges.shape)
    empty = (rng.random(ranges.shape) < NO_ECHO) | (ranges > MAX_RANGE)
    write_arrays(
        target / "corridor.npz",
        ranges=np.where(empty, MAX_RANGE, ranges).astype(np.float32),
        angles=angles,
        poses=poses,
        walls=WALLS,
        wall_of_beam=np.where(empty, -1, hit).astype(np.int8),
    )


def _to_wall(poses: np.ndarray, directions: np.ndarray, wall: np.ndarray) -> np.ndarray:
    """Distances (K, B) along the beams to one wall, infinite where a beam misses it."""
    start, along = wall[:2], wall[2:] - wall[:2]
    dx, dy = np.cos(directions), np.sin(directions)
    to_start = start - poses[:, :2]
    across = dx * along[1] - dy * along[0]
    with np.errstate(divide="ignore", invalid="ignore"):
        distance = (to_start[:, :1] * along[1] - to_start[:, 1:] * along[0]) / across
        position = (to_start[:, :1] * dy - to_start[:, 1:] * dx) / across
    meets = (distance > 0) & (position >= 0) & (position <= 1)
    return np.where(meets, distance, np.inf)


def _to_circle(poses: np.ndarray, directions: np.ndarray, center: np.ndarray) -> np.ndarray:
    """Distances (K, B) along the beams to a person, infinite where a beam misses them."""
    dx, dy = np.cos(directions), np.sin(directions)
    to_center = center - poses[:, :2]
    nearest = to_center[:, :1] * dx + to_center[:, 1:] * dy
    gap = np.sum(to_center**2, axis=1, keepdims=True) - nearest**2
    with np.errstate(invalid="ignore"):
        distance = nearest - np.sqrt(PERSON_RADIUS**2 - gap)
    return np.where((gap < PERSON_RADIUS**2) & (distance > 0), distance, np.inf)
