"""True and false positives of extracted segments, after Nguyen et al. (IROS 2005)."""

import math

import numpy as np

from benchmarks.scenes import Scene


def rates(scenes: list[Scene], extracted: list[np.ndarray]) -> tuple[float, float]:
    """The true and the false positive rate.

    `extracted` holds for each scene (S, 2, 2) end points in metres. The first rate is the
    share of visible walls that at least one segment matches. The second one is the share of
    segments that match no wall, or report a stretch of a wall that a longer one reports
    already. Several segments on different stretches of one wall are right.
    """
    found = visible = wrong = segments = 0
    for scene, ends in zip(scenes, extracted, strict=True):
        match = matches(ends, scene.walls)
        found += int((match.any(axis=0) & scene.visible).sum())
        visible += int(scene.visible.sum())
        wrong += int((~match.any(axis=1) | repeats(ends, match, scene.walls)).sum())
        segments += len(ends)
    return found / max(visible, 1), wrong / max(segments, 1)


def repeats(ends: np.ndarray, match: np.ndarray, walls: np.ndarray) -> np.ndarray:
    """Whether half of a segment, or more, is on what longer ones cover already, as (S,)."""
    repeated = np.zeros(len(ends), dtype=bool)
    longest_first = np.argsort(-np.hypot(*(ends[:, 1] - ends[:, 0]).T))
    for wall in np.flatnonzero(match.any(axis=0)):
        along = walls[wall, 1] - walls[wall, 0]
        position = np.sort((ends - walls[wall, 0]) @ along / np.hypot(*along), axis=1)
        covered: list[np.ndarray] = []
        for segment in longest_first[match[longest_first, wall]]:
            start, end = position[segment]
            overlap = sum(max(0.0, min(end, b) - max(start, a)) for a, b in covered)
            if overlap > 0.5 * (end - start):
                repeated[segment] = True
            else:
                covered.append(position[segment])
    return repeated


def matches(
    ends: np.ndarray,
    walls: np.ndarray,
    distance: float = 0.05,
    angle: float = math.radians(6.0),
    overhang: float = 0.25,
) -> np.ndarray:
    """Whether a segment lies on a wall, as (S, K).

    Its ends are at most `distance` metres from the wall's line and `overhang` metres beyond
    the wall's ends, and its direction differs by at most `angle`.
    """
    along = walls[:, 1] - walls[:, 0]
    length = np.hypot(along[:, 0], along[:, 1])
    along = along / length[:, None]
    normal = along[:, ::-1] * [-1.0, 1.0]
    offset = ends[:, :, None] - walls[:, 0]  # (S, 2, K, 2)
    across = np.abs(np.sum(offset * normal, axis=-1))
    position = np.sum(offset * along, axis=-1)
    direction = ends[:, 1] - ends[:, 0]
    sine = np.abs(direction @ normal.T) / np.hypot(direction[:, 0], direction[:, 1])[:, None]
    on_line = (across <= distance).all(axis=1) & (sine <= math.sin(angle))
    return on_line & ((position >= -overhang) & (position <= length + overhang)).all(axis=1)
