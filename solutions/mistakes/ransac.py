"""What students write for the RANSAC questions, and what goes wrong."""

import math

import numpy as np

from solutions.lines.line_fitting import distances, fit_line
from solutions.ransac.line import ransac_line


def _at_the_edges(p, w):
    """What is right where there is nothing to compute."""
    if not (0 < p < 1 and 0 <= w <= 1):
        raise ValueError("out of range")
    return {1: 1, 0: math.inf}.get(w)


def rounds_down(p, w, s):
    """Cuts the fraction off: one iteration too few."""
    return _at_the_edges(p, w) or int(math.log1p(-p) / math.log1p(-(w**s)))


def always_adds_one(p, w, s):
    """Cuts the fraction off and adds one: one too many where there is no fraction."""
    return _at_the_edges(p, w) or int(math.log1p(-p) / math.log1p(-(w**s))) + 1


def does_not_round(p, w, s):
    """Returns a fraction of an iteration."""
    return _at_the_edges(p, w) or math.log1p(-p) / math.log1p(-(w**s))


def needs_one_inlier(p, w, s):
    """Uses w for w**s, as if one inlier in a sample were enough."""
    return _at_the_edges(p, w) or math.ceil(math.log1p(-p) / math.log1p(-w))


def takes_p_for_failure(p, w, s):
    """Uses log(p): the iterations until failure is as likely as success should be."""
    return _at_the_edges(p, w) or math.ceil(math.log(p) / math.log1p(-(w**s)))


def always_pairs(p, w, s):
    """Ignores s and always samples two points."""
    return _at_the_edges(p, w) or math.ceil(math.log1p(-p) / math.log1p(-(w**2)))


def rejects_one_outlier(p, w, s):
    """Uses 1 - (1 - w)**s: a sample with one inlier or more."""
    return _at_the_edges(p, w) or math.ceil(math.log1p(-p) / math.log((1 - w) ** s))


def loses_tiny_probabilities(p, w, s):
    """Uses log(1 - w**s), in which a tiny w**s is rounded away."""
    return _at_the_edges(p, w) or math.ceil(math.log(1 - p) / math.log(1 - w**s))


def forgets_the_edges(p, w, s):
    """The formula alone: nothing is checked, and w = 1 asks for the logarithm of zero."""
    return math.ceil(math.log1p(-p) / math.log1p(-(w**s)))


def bare_formula(p, w, s):
    """The formula as it is printed: no edges, and a tiny w**s is rounded away."""
    return math.ceil(math.log(1 - p) / math.log(1 - w**s))


def bare_formula_rounded_down(p, w, s):
    """The formula as it is printed, with int() for the next whole number."""
    return int(math.log(1 - p) / math.log(1 - w**s))


def rounds_down_without_edges(p, w, s):
    """Cuts the fraction off, and checks nothing."""
    return int(math.log1p(-p) / math.log1p(-(w**s)))


def zero_at_the_edges(p, w, s):
    """Returns 0 where the logarithm has no value."""
    _at_the_edges(p, w)
    return 0 if w in (0, 1) else math.ceil(math.log1p(-p) / math.log1p(-(w**s)))


def checks_no_range(p, w, s):
    """Knows w = 0 and w = 1, but computes something for values that cannot be."""
    if w in (0, 1):
        return {1: 1, 0: math.inf}[w]
    return math.ceil(math.log1p(-p) / math.log1p(-(w**s)))


def _ransac_line(points, threshold, iterations, rng, agrees=None, better=None, band=None):
    """RANSAC for a line with parts to replace by wrong ones."""
    band = threshold if band is None else band
    agrees = agrees or (lambda distance: np.abs(distance) <= band)
    better = better or (lambda new, old: len(new) > len(old))
    best, best_line = np.array([], dtype=int), None
    for _ in range(iterations):
        pair = rng.choice(len(points), size=2, replace=False)
        if np.array_equal(*points[pair]):
            continue
        line = fit_line(points[pair])
        agreeing = np.flatnonzero(agrees(distances(points, line)))
        if better(agreeing, best):
            best, best_line = agreeing, line
    if best_line is None or len(best) < 2:
        raise ValueError("no line")
    return best_line, best


def _refitted(points, best, band):
    line = fit_line(points[best])
    return line, np.flatnonzero(np.abs(distances(points, line)) <= band)


def keeps_the_sample_line(points, threshold, iterations, rng):
    """Returns the line through the two sampled points, without a fit to all that agree."""
    return _ransac_line(points, threshold, iterations, rng)


def keeps_the_last_hypothesis(points, threshold, iterations, rng):
    """Overwrites the best consensus set in every iteration."""
    _, best = _ransac_line(points, threshold, iterations, rng, better=lambda new, old: True)
    return _refitted(points, best, threshold)


def forgets_the_absolute_value(points, threshold, iterations, rng):
    """Counts all points on the near side of the line: a signed distance below the threshold."""
    _, best = _ransac_line(points, threshold, iterations, rng, agrees=lambda d: d <= threshold)
    return _refitted(points, best, threshold)


def fits_all_points(points, threshold, iterations, rng):
    """Least squares over everything, outliers too."""
    line = fit_line(points)
    return line, np.flatnonzero(np.abs(distances(points, line)) <= threshold)


def returns_the_outliers(points, threshold, iterations, rng):
    """Returns the indices of the points that do not agree."""
    line, inliers = ransac_line(points, threshold, iterations, rng)
    return line, np.setdiff1d(np.arange(len(points)), inliers)


def compares_the_square(points, threshold, iterations, rng):
    """Compares the squared distance with the threshold: the band has the width of its root."""
    band = math.sqrt(threshold)
    _, best = _ransac_line(points, threshold, iterations, rng, band=band)
    return _refitted(points, best, band)


def halves_the_band(points, threshold, iterations, rng):
    """Takes the threshold for the width of the whole band."""
    _, best = _ransac_line(points, threshold, iterations, rng, band=threshold / 2)
    return _refitted(points, best, threshold / 2)


def fixes_the_threshold(points, threshold, iterations, rng):
    """Writes 0.1 in place of the argument."""
    _, best = _ransac_line(points, threshold, iterations, rng, band=0.1)
    return _refitted(points, best, 0.1)


def fixes_both_numbers(points, threshold, iterations, rng):
    """Writes numbers in place of both arguments."""
    return fixes_the_threshold(points, threshold, 300, rng)


def fixes_few_iterations(points, threshold, iterations, rng):
    """Draws 40 samples, whatever was asked for."""
    return ransac_line(points, threshold, 40, rng)


def fixes_many_iterations(points, threshold, iterations, rng):
    """Draws 300 samples, whatever was asked for."""
    return ransac_line(points, threshold, 300, rng)


def makes_its_own_generator(points, threshold, iterations, rng):
    """Leaves the generator that it was given alone."""
    return ransac_line(points, threshold, iterations, np.random.default_rng(0))


def returns_something_without_a_line(points, threshold, iterations, rng):
    """Raises nothing where no sample gave a line."""
    try:
        return ransac_line(points, threshold, iterations, rng)
    except ValueError:
        return None, np.array([], dtype=int)
