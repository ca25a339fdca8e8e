"""RANSAC: find a model that many points agree with, although most may not.

Draw minimal samples, make a hypothesis of each, count the points that agree, keep the best,
and fit it again to all points that agree. `solutions.ransac.line` does this one hypothesis
after the other, as the course explains it. Here a hypothesis is a row (normal, r), so that
one matrix product gives the distances of all points to all hypotheses.

Source: Fischler and Bolles, Random Sample Consensus, CACM 24(6), 1981.
"""

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np

from solutions.lines.line_fitting import distances, fit_line
from solutions.lines.plane_fitting import fit_plane, plane_distances
from solutions.ransac.probabilities import (
    candidate_count,
    outlier_model_probability,
    required_iterations,
    success_probability,
)

__all__ = [
    "Consensus",
    "candidate_count",
    "draw_samples",
    "outlier_model_probability",
    "ransac_line",
    "ransac_plane",
    "required_iterations",
    "success_probability",
]

# Distances held at once: 128 KB in single precision. Twice as many save 6 % at best; but glibc may
# give arrays of that size back to the system after each call, and fetching their pages again takes
# nearly as long as everything else.
BLOCK = 2**15
DRAWN_AT_ONCE = 512  # samples


class Consensus(NamedTuple):
    """A model and the points that agree with it."""

    model: Any  # Line or Plane
    inliers: np.ndarray  # sorted indices of the points within the threshold
    iterations: int  # hypotheses tried


class _Kind(NamedTuple):
    """What RANSAC has to know about a kind of model."""

    sample_size: int
    hypotheses_through: Callable[..., np.ndarray]
    fit: Callable[[np.ndarray], Any]
    distances: Callable[[np.ndarray, Any], np.ndarray]


def ransac_line(
    points: np.ndarray,
    threshold: float,
    iterations: int,
    rng: np.random.Generator,
    confidence: float | None = None,
) -> Consensus | None:
    """Return the line that most of the (N, 2) points agree with, or None if there is none.

    A point agrees if it is at most `threshold` metres from the line. `iterations` samples of
    two different points are drawn; with a `confidence` (between 0 and 1) fewer, as soon as
    the inliers seen so far make it that likely that an all-inlier sample was among them. The
    line is a least-squares fit to its consensus set. None means that no sample gave a line,
    because all points are equal, say; or that the points that agree with the best one fix no
    line, because they are as wide as long.

    Raises:
        ValueError: for fewer than two points, coordinates that are not finite, a threshold that
            is not positive, or iterations that are not a whole number of at least 1.
    """
    kind = _Kind(2, _lines_through, fit_line, distances)
    return _ransac(kind, points, threshold, iterations, rng, confidence)


def ransac_plane(
    points: np.ndarray,
    threshold: float,
    iterations: int,
    rng: np.random.Generator,
    confidence: float | None = None,
) -> Consensus | None:
    """Return the plane that most of the (N, 3) points agree with, or None if there is none.

    As `ransac_line`, with samples of three points.
    """
    kind = _Kind(3, _planes_through, fit_plane, plane_distances)
    return _ransac(kind, points, threshold, iterations, rng, confidence)


def draw_samples(N: int, s: int, count: int, rng: np.random.Generator) -> np.ndarray:
    """Return (s, count) indices below N; the s indices of one sample, a column, all differ.

    Every set of s is equally likely (Floyd's method: Bentley, Programming Pearls, CACM 1987).
    """
    if not isinstance(rng, np.random.Generator):
        raise TypeError(f"Samples are drawn with a np.random.Generator, not with {rng!r}.")
    last = np.arange(N - s, N)[:, None]
    samples = (rng.random((s, count)) * (last + 1)).astype(np.intp)
    for i in range(1, s):
        drawn_before = (samples[:i] == samples[i]).any(axis=0)
        samples[i, drawn_before] = last[i]
    return samples


def _lines_through(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return (3, k) columns (normal, r), given (2, k) coordinates of k pairs of points."""
    normal = np.array([y[0] - y[1], x[1] - x[0]])
    normal /= np.hypot(normal[0], normal[1])
    return np.array([*normal, normal[0] * x[0] + normal[1] * y[0]])


def _planes_through(x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return (4, k) columns (normal, r), given (3, k) coordinates of k triples of points."""
    (ux, vx), (uy, vy), (uz, vz) = x[1:] - x[0], y[1:] - y[0], z[1:] - z[0]
    normal = np.array([uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx])
    normal /= np.sqrt(normal[0] ** 2 + normal[1] ** 2 + normal[2] ** 2)
    return np.array([*normal, normal[0] * x[0] + normal[1] * y[0] + normal[2] * z[0]])


def _ransac(
    kind: _Kind,
    points: np.ndarray,
    threshold: float,
    iterations: int,
    rng: np.random.Generator,
    confidence: float | None,
) -> Consensus | None:
    s = kind.sample_size
    points = _checked(points, s, threshold, iterations, confidence)
    N = len(points)
    # Seen from among the points, single precision is enough for counting.
    coordinates = (points - _middle(points)).T
    coarse = threshold > 1e-5 * np.abs(coordinates).max()
    precision = np.float32 if coarse else np.float64
    homogeneous = np.empty((s + 1, N), precision)  # (normal, r) @ this = distances
    homogeneous[:s], homogeneous[s] = coordinates, -1.0
    rows = min(iterations, max(1, BLOCK // N))
    workspace = np.empty((rows, N), precision)

    best_count, agrees, tried = 0, np.zeros(N, dtype=bool), 0
    count_type = np.min_scalar_type(N)
    for hypotheses in _blocks(kind, coordinates, iterations, rows, precision, rng):
        distance = workspace[: len(hypotheses)]
        np.matmul(hypotheses, homogeneous, out=distance)
        close = np.abs(distance, out=distance) <= threshold
        counts = close.sum(axis=1, dtype=count_type)
        winner = counts.argmax()
        if counts[winner] > best_count:
            best_count, agrees = int(counts[winner]), close[winner].copy()
        tried += len(hypotheses)
        if confidence and tried >= required_iterations(confidence, best_count / N, s):
            break

    return _refit(kind, points, agrees, threshold, tried) if best_count >= s else None


def _blocks(
    kind: _Kind,
    coordinates: np.ndarray,
    iterations: int,
    rows: int,
    precision: type[np.floating],
    rng: np.random.Generator,
) -> Iterator[np.ndarray]:
    """Yield all hypotheses in blocks of so many rows; some hundreds are made at a time."""
    N = coordinates.shape[1]
    for start in range(0, iterations, DRAWN_AT_ONCE):
        count = min(DRAWN_AT_ONCE, iterations - start)
        samples = draw_samples(N, kind.sample_size, count, rng)
        # A degenerate sample gives NaN, which is close to no point.
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            columns = kind.hypotheses_through(*np.take(coordinates, samples, axis=1))
            hypotheses = columns.T.astype(precision, order="C")
        for row in range(0, count, rows):
            yield hypotheses[row : row + rows]


def _middle(points: np.ndarray) -> np.ndarray:
    """Return the median of some points: a mark for "no echo", such as 1e30, is not the middle."""
    some = points[:: -(-len(points) // 25)]
    return np.sort(some, axis=0)[len(some) // 2]


def _refit(
    kind: _Kind, points: np.ndarray, agrees: np.ndarray, threshold: float, tried: int
) -> Consensus | None:
    """Fit to the points that agree, again and again as long as over 1 % more of them do.

    A few points near the threshold come and go with every fit; they are not worth another one.
    """
    while True:
        try:
            model = kind.fit(points[agrees])
        except ValueError:  # all that agree are in one spot, say: they define no model
            return None
        count = np.count_nonzero(agrees)
        agrees = np.abs(kind.distances(points, model)) <= threshold
        if np.count_nonzero(agrees) < kind.sample_size:
            return None  # the fit has lost them all: a model without inliers is no model
        if np.count_nonzero(agrees) <= 1.01 * count:
            return Consensus(model, np.flatnonzero(agrees), tried)


def _checked(
    points: np.ndarray, s: int, threshold: float, iterations: int, confidence: float | None
) -> np.ndarray:
    """Return the points as floats, or say in one sentence what is wrong with the input."""
    if np.ma.is_masked(points):
        raise ValueError("Some points are masked; leave them out first.")
    points = np.asarray(points, dtype=float)
    if points.ndim != 2 or points.shape[1] != s:
        raise ValueError(f"The points must be an (N, {s}) array, not {points.shape}.")
    if len(points) < s:
        raise ValueError(f"A sample needs {s} points, but there are only {len(points)}.")
    if not np.isfinite(points).all():
        raise ValueError(
            "Some coordinates are not finite: keep points[np.isfinite(points).all(axis=1)]."
        )
    whole = isinstance(iterations, int | np.integer)
    if not (threshold > 0 and whole and iterations >= 1):
        raise ValueError(
            "Needs threshold > 0 and a whole number of iterations >= 1, "
            f"not {threshold} and {iterations}."
        )
    if confidence is not None and not 0 < confidence < 1:
        raise ValueError(f"The confidence must be between 0 and 1, not {confidence}.")
    return points
