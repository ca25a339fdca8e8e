"""RANSAC as the course explains it: one hypothesis after the other.

`solutions.ransac.fast.consensus.ransac_line` is the same algorithm with all hypotheses in one
matrix product.
"""

import numpy as np

from solutions.lines.line_fitting import Line, distances, fit_line


def ransac_line(
    points: np.ndarray, threshold: float, iterations: int, rng: np.random.Generator
) -> tuple[Line, np.ndarray]:
    """Return the line that most points agree with, and the indices of these points.

    `points` is an (N, 2) array in metres. Each of the `iterations` samples is a pair of two
    different points, drawn with `rng`; its line is the hypothesis, and a point agrees if it
    is at most `threshold` metres away, on either side. The line of the largest consensus set
    is fitted again, with least squares, to all points of that set. The indices, in any order,
    are those of the points within the threshold of this last line; they may be those of the
    consensus set as well, which is nearly always the same.

    Raises:
        ValueError: if no sample gave a line, as when all points are equal or `iterations` is 0.
    """
    if not isinstance(rng, np.random.Generator):
        raise TypeError(f"Samples are drawn with a np.random.Generator, not with {rng!r}.")
    if np.ma.is_masked(points):  # the mask would be dropped without a word
        raise TypeError("Some points are masked; leave them out first.")
    best = np.array([], dtype=int)
    for _ in range(iterations):
        pair = rng.choice(len(points), size=2, replace=False)
        if np.array_equal(*points[pair]):  # equal points are on many lines
            continue
        hypothesis = fit_line(points[pair])
        agreeing = np.flatnonzero(np.abs(distances(points, hypothesis)) <= threshold)
        if len(agreeing) > len(best):
            best = agreeing
    if len(best) == 0:
        raise ValueError("No line: no sample had two different points.")
    line = fit_line(points[best])
    return line, np.flatnonzero(np.abs(distances(points, line)) <= threshold)
