"""What students write for the RANSAC questions, and what goes wrong."""

import math

import numpy as np

from solutions.lines.line_fitting import Line, distances, fit_line


def rounds_down(p, w, s):
    """Cuts the fraction off: one iteration too few."""
    return int(math.log1p(-p) / math.log1p(-(w**s)))


def does_not_round(p, w, s):
    """Returns a fraction of an iteration."""
    return math.log1p(-p) / math.log1p(-(w**s))


def needs_one_inlier(p, w, s):
    """Uses w for w**s, as if one inlier in a sample were enough."""
    return math.ceil(math.log1p(-p) / math.log1p(-w))


def takes_p_for_failure(p, w, s):
    """Uses log(p): the iterations until failure is as likely as success should be."""
    return math.ceil(math.log(p) / math.log1p(-(w**s)))


def always_pairs(p, w, s):
    """Ignores s and always samples two points."""
    return math.ceil(math.log1p(-p) / math.log1p(-(w**2)))


def rejects_one_outlier(p, w, s):
    """Uses 1 - (1 - w)**s: a sample with one inlier or more."""
    return math.ceil(math.log1p(-p) / math.log((1 - w) ** s))


def loses_tiny_probabilities(p, w, s):
    """Uses log(1 - w**s), in which a tiny w**s is rounded away."""
    return math.ceil(math.log(1 - p) / math.log(1 - w**s))


def _ransac_line(points, threshold, iterations, rng, agrees=None, better=None, refit=True):
    """RANSAC for a line with parts to replace by wrong ones."""
    agrees = agrees or (lambda distance: np.abs(distance) <= threshold)
    better = better or (lambda new, old: len(new) > len(old))
    best, best_line = np.array([], dtype=int), Line(0.0, 0.0)
    for _ in range(iterations):
        line = fit_line(points[rng.choice(len(points), size=2, replace=False)])
        agreeing = np.flatnonzero(agrees(distances(points, line)))
        if better(agreeing, best):
            best, best_line = agreeing, line
    if refit:
        best_line = fit_line(points[best])
    return best_line, np.flatnonzero(np.abs(distances(points, best_line)) <= threshold)


def keeps_the_sample_line(points, threshold, iterations, rng):
    """Returns the line through the two sampled points, without a fit to all that agree."""
    return _ransac_line(points, threshold, iterations, rng, refit=False)


def keeps_the_last_hypothesis(points, threshold, iterations, rng):
    """Overwrites the best consensus set in every iteration."""
    return _ransac_line(points, threshold, iterations, rng, better=lambda new, old: True)


def forgets_the_absolute_value(points, threshold, iterations, rng):
    """Counts all points on the near side of the line: a signed distance below the threshold."""
    return _ransac_line(points, threshold, iterations, rng, agrees=lambda d: d <= threshold)


def fits_all_points(points, threshold, iterations, rng):
    """Least squares over everything, outliers too."""
    line = fit_line(points)
    return line, np.flatnonzero(np.abs(distances(points, line)) <= threshold)


def returns_the_outliers(points, threshold, iterations, rng):
    """Returns the indices of the points that do not agree."""
    line, inliers = _ransac_line(points, threshold, iterations, rng)
    return line, np.setdiff1d(np.arange(len(points)), inliers)
