"""k-means clustering: what happens at one node of the vocabulary tree.

Source: Lloyd, Least squares quantization in PCM, IEEE Transactions on Information Theory, 1982.
"""

import numpy as np


def k_means(
    points: np.ndarray, k: int, rng: np.random.Generator, iterations: int = 10
) -> np.ndarray:
    """Divide points into clusters around k centres; return the centres.

    `points` is (N, d) float32 with N at least 1. The centres are (m, d) with m at most k; each
    has at least one point nearest to it. With k different points or fewer, each of them gets a
    centre of its own. With more, m is nearly always k: a cluster may lose its last point in the
    last iteration. The centres start at points drawn with `rng`. Giving every point to the
    nearest centre, and moving every centre to the mean of its points, is repeated until no
    point changes its cluster, at most `iterations` times.
    """
    centers = points[rng.choice(len(points), size=min(k, len(points)), replace=False)]
    nearest = np.full(len(points), -1)
    for _ in range(iterations):
        previous, nearest = nearest, nearest_centers(points, centers)
        if np.array_equal(nearest, previous):
            break
        centers = _moved(points, nearest, centers)
    return centers[np.unique(nearest_centers(points, centers))]


def nearest_centers(points: np.ndarray, centers: np.ndarray) -> np.ndarray:
    """Return (N,) rows of the nearest of (K, d) centres for (N, d) points.

    See `words.assign_words`.
    """
    closeness = points @ centers.T
    closeness -= half_squares(centers)
    return closeness.argmax(axis=1)


def half_squares(centers: np.ndarray) -> np.ndarray:
    """Return |c|²/2 of (..., K, d) centres: (..., K)."""
    return 0.5 * np.einsum("...d,...d->...", centers, centers)


def _moved(points: np.ndarray, nearest: np.ndarray, centers: np.ndarray) -> np.ndarray:
    """Return the mean of the points of each cluster; an empty one starts anew, far out."""
    # A row says for one cluster which points it has; its product with the points adds them up.
    one_hot = (np.arange(len(centers))[:, None] == nearest).astype(points.dtype)
    counts = one_hot.sum(axis=1)
    means = one_hot @ points / np.maximum(counts, 1)[:, None]
    empty = np.flatnonzero(counts == 0)
    if len(empty):
        # At different points: two centres in one spot would leave one of them empty again.
        different = np.unique(points, axis=0, return_index=True)[1]
        own = centers[nearest[different]]
        errors = ((points[different] - own) ** 2).sum(axis=1)
        farthest = different[np.argsort(errors)[-len(empty) :]]
        means[empty] = points[np.resize(farthest, len(empty))]
    return means
