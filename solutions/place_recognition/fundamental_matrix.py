"""The fundamental matrix of two photographs of one place, found by RANSAC.

If the world stands still, a point seen at x in one image and at y in the other, both written as
(column, row, 1), satisfies y' F x = 0. This is chapter 3 again: the model is F, a sample has
eight matches, and a match agrees if it lies close to where F says.

Sources: Hartley, In defense of the eight-point algorithm, TPAMI 1997; Hartley and Zisserman,
Multiple View Geometry, 2nd ed., algorithms 11.1 and 11.4, and the Sampson distance (11.9).
"""

from typing import NamedTuple

import numpy as np

from solutions.ransac.fast.consensus import draw_samples
from solutions.ransac.probabilities import required_iterations

SAMPLE_SIZE = 8
TRIED_AT_ONCE = 64


class Epipolar(NamedTuple):
    """Two-view geometry and the matches that agree with it."""

    matrix: np.ndarray  # (3, 3), of rank 2
    inliers: np.ndarray  # sorted indices of the matches within the threshold


def ransac_fundamental(
    x: np.ndarray,
    y: np.ndarray,
    rng: np.random.Generator,
    threshold: float = 2.0,
    iterations: int = 2000,
    confidence: float = 0.99,
) -> Epipolar | None:
    """Return the fundamental matrix that most matches agree with, or None if there is none.

    Match i is at x[i] in one image and at y[i] in the other; both arrays are (N, 2), in
    pixels. A match agrees if its Sampson distance is at most `threshold` pixels. At most
    `iterations` samples are drawn, fewer once an all-inlier sample was drawn with this
    `confidence`. None means that fewer than eight matches agree, or that all of them would
    agree by themselves: on one line or in one spot of an image, anything fits.

    Raises:
        ValueError: for two arrays of different lengths, positions that are not finite, or a
            threshold, number of iterations or confidence out of range.
    """
    x, y = _checked(x, y, threshold, iterations, confidence)
    N = len(x)
    if N < SAMPLE_SIZE:
        return None
    tried, best = 0, Epipolar(np.zeros((3, 3)), np.zeros(0, dtype=np.intp))
    while tried < iterations:
        samples = draw_samples(N, SAMPLE_SIZE, min(TRIED_AT_ONCE, iterations - tried), rng).T
        best = _better(best, samples, x, y, threshold)
        tried += len(samples)
        inlier_ratio = len(best.inliers) / N
        if tried >= required_iterations(confidence, inlier_ratio, SAMPLE_SIZE):
            break
    # Fit to all that agree, again and again as long as more of them do.
    previous = None
    while previous is not best and len(best.inliers) >= SAMPLE_SIZE:
        previous = best
        best = _better(best, best.inliers[None], x, y, threshold)
    return best if len(best.inliers) >= SAMPLE_SIZE else None


def fit_fundamental(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the (k, 3, 3) matrices that k sets of n matches fix, with the eight-point algorithm.

    Both arrays are (k, n, 2), n at least 8. F minimises the sum of (y' F x)² over coordinates
    that were centred and scaled, which is what makes the algorithm accurate.
    """
    return _fit_with_rank_one(x, y)[0]


def _fit_with_rank_one(x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the matrices of `fit_fundamental`, and the largest rank-one part of each."""
    (x, to_x), (y, to_y) = _normalised(x), _normalised(y)
    # Row (y1 x1, y1 x2, y1, y2 x1, ...) times the nine entries of F is y' F x.
    rows = (y[..., :, None] * x[..., None, :]).reshape(*x.shape[:2], 9)
    _, vectors = np.linalg.eigh(rows.swapaxes(1, 2) @ rows)
    F = vectors[..., 0].reshape(-1, 3, 3)
    U, sizes, Vt = np.linalg.svd(F)
    largest = sizes * [1.0, 0.0, 0.0]
    # All epipolar lines meet in one point: the smallest singular value has to be 0.
    two_largest = sizes * [1.0, 1.0, 0.0]
    back = to_y.swapaxes(1, 2)
    F, rank_one = (back @ (U * kept[:, None, :] @ Vt) @ to_x for kept in (two_largest, largest))
    return F, rank_one


def sampson_distances(matrices: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return (k, N) pixels: how far N matches are from agreeing with k fundamental matrices.

    To first order this is how far the match, a point in four dimensions, has to be moved.
    """
    x, y = _homogeneous(x), _homogeneous(y)
    lines_in_y = matrices @ x.T  # (k, 3, N)
    lines_in_x = matrices.swapaxes(1, 2) @ y.T
    errors = (lines_in_y * y.T).sum(axis=1)
    slopes = (lines_in_y[:, :2] ** 2).sum(axis=1) + (lines_in_x[:, :2] ** 2).sum(axis=1)
    return np.abs(errors) / np.sqrt(np.maximum(slopes, 1e-300))


def _better(
    best: Epipolar, samples: np.ndarray, x: np.ndarray, y: np.ndarray, threshold: float
) -> Epipolar:
    """Return the matrix of one of the (k, n) samples if more matches agree with it than so far."""
    matrices, rank_one = _fit_with_rank_one(x[samples], y[samples])
    agree = sampson_distances(matrices, x, y) <= threshold
    counts = agree.sum(axis=1)
    for i in np.argsort(-counts, kind="stable"):
        if counts[i] <= len(best.inliers):
            break
        inliers = np.flatnonzero(agree[i])
        if not _is_degenerate(rank_one[i], x[inliers], y[inliers], threshold):
            return Epipolar(matrices[i], inliers)
    return best


def _is_degenerate(rank_one: np.ndarray, x: np.ndarray, y: np.ndarray, threshold: float) -> bool:
    """Tell whether the matches that agree are no sign of two views of one place.

    A matrix of rank one, a l', agrees with every match that is on the line l in the one image
    or on the line a in the other, wherever its other end is. So the matches say nothing if
    this part of the matrix explains half of them, or if they form a line in one image.
    """
    on_lines = sampson_distances(rank_one[None], x, y) <= threshold
    if 2 * np.count_nonzero(on_lines) >= len(x):
        return True
    return min(np.linalg.eigvalsh(np.cov(p.T, bias=True))[0] for p in (x, y)) <= threshold**2


def _checked(
    x: np.ndarray, y: np.ndarray, threshold: float, iterations: int, confidence: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return the positions as floats, or say in one sentence what is wrong with the input."""
    if np.ma.is_masked(x) or np.ma.is_masked(y):
        raise ValueError("Some positions are masked: leave these matches out.")
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    if x.ndim != 2 or x.shape[1] != 2 or x.shape != y.shape:
        raise ValueError(f"The positions must be two (N, 2) arrays, not {x.shape} and {y.shape}.")
    if not (np.isfinite(x).all() and np.isfinite(y).all()):
        raise ValueError("Some positions are not finite: leave these matches out.")
    if not (threshold > 0 and iterations >= 1 and 0 < confidence < 1):
        raise ValueError(
            f"Needs threshold > 0, iterations >= 1 and 0 < confidence < 1, not {threshold}, "
            f"{iterations} and {confidence}."
        )
    return x, y


def _normalised(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return (k, n, 3) points about the origin at a mean distance of √2, and the transforms."""
    center = points.mean(axis=1)
    spread = np.linalg.norm(points - center[:, None], axis=2).mean(axis=1)
    scale = np.sqrt(2.0) / np.maximum(spread, 1e-12)
    transform = np.zeros((len(points), 3, 3))
    transform[:, 0, 0] = transform[:, 1, 1] = scale
    transform[:, :2, 2] = -scale[:, None] * center
    transform[:, 2, 2] = 1.0
    return _homogeneous(points) @ transform.swapaxes(1, 2), transform


def _homogeneous(points: np.ndarray) -> np.ndarray:
    return np.concatenate([points, np.ones((*points.shape[:-1], 1))], axis=-1)
