"""The fundamental matrix of two photographs of one place, found by RANSAC.

If the world stands still, a point seen at x in one image and at y in the other, both written as
(column, row, 1), satisfies y' F x = 0. This is chapter 3 again: the model is F, a sample has
eight matches, and a match agrees if it lies close to where F says.

Sources: Hartley, In defense of the eight-point algorithm, TPAMI 1997; Hartley and Zisserman,
Multiple View Geometry, 2nd ed., algorithms 11.1 and 11.4, and the Sampson distance (11.9).
"""

from typing import NamedTuple

import numpy as np

from solutions.ransac import draw_samples
from solutions.ransac_probabilities import required_iterations

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
    `confidence`. Fewer than eight matches have no model.
    """
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    N = len(x)
    if N < SAMPLE_SIZE:
        return None
    tried, best = 0, Epipolar(np.zeros((3, 3)), np.zeros(0, dtype=np.intp))
    while tried < iterations:
        samples = draw_samples(N, SAMPLE_SIZE, TRIED_AT_ONCE, rng).T
        best = _better(best, fit_fundamental(x[samples], y[samples]), x, y, threshold)
        tried += len(samples)
        inlier_ratio = len(best.inliers) / N
        if tried >= required_iterations(confidence, inlier_ratio, SAMPLE_SIZE):
            break
    # Fit to all that agree, again and again as long as more of them do.
    previous = None
    while previous is not best and len(best.inliers) >= SAMPLE_SIZE:
        previous, agreeing = best, best.inliers
        best = _better(best, fit_fundamental(x[None, agreeing], y[None, agreeing]), x, y, threshold)
    return best if len(best.inliers) >= SAMPLE_SIZE else None


def fit_fundamental(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the (k, 3, 3) matrices that k sets of n matches fix, with the eight-point algorithm.

    Both arrays are (k, n, 2), n at least 8. F minimises the sum of (y' F x)² over coordinates
    that were centred and scaled, which is what makes the algorithm accurate.
    """
    (x, to_x), (y, to_y) = _normalised(x), _normalised(y)
    # Row (y1 x1, y1 x2, y1, y2 x1, ...) times the nine entries of F is y' F x.
    rows = (y[..., :, None] * x[..., None, :]).reshape(*x.shape[:2], 9)
    _, vectors = np.linalg.eigh(rows.swapaxes(1, 2) @ rows)
    F = vectors[..., 0].reshape(-1, 3, 3)
    # All epipolar lines meet in one point: the smallest singular value has to be 0.
    U, sizes, Vt = np.linalg.svd(F)
    sizes[:, 2] = 0.0
    F = U * sizes[:, None, :] @ Vt
    return to_y.swapaxes(1, 2) @ F @ to_x


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
    best: Epipolar, hypotheses: np.ndarray, x: np.ndarray, y: np.ndarray, threshold: float
) -> Epipolar:
    """Return the hypothesis that most matches agree with if there are more than so far."""
    agree = sampson_distances(hypotheses, x, y) <= threshold
    counts = agree.sum(axis=1)
    winner = counts.argmax()
    if counts[winner] <= len(best.inliers):
        return best
    return Epipolar(hypotheses[winner], np.flatnonzero(agree[winner]))


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
