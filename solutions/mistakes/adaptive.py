"""What students write for the questions about adaptive stopping and MSAC, and what goes wrong."""

import numpy as np

from solutions.ransac.probabilities import required_iterations


def uses_the_last_sample(agreeing, N, p):
    """Takes the share of the last sample, not of the best one."""
    for drawn, count in enumerate(agreeing, start=1):
        if drawn >= required_iterations(p, count / N, 2):
            return drawn
    return len(agreeing)


def knows_the_best_beforehand(agreeing, N, p):
    """Computes once, from the best sample of the whole run."""
    if len(agreeing) == 0:
        return 0
    return min(len(agreeing), required_iterations(p, max(agreeing) / N, 2))


def stops_one_late(agreeing, N, p):
    """Wants more samples than are required."""
    best = 0
    for drawn, count in enumerate(agreeing, start=1):
        best = max(best, count)
        if drawn > required_iterations(p, best / N, 2):
            return drawn
    return len(agreeing)


def counts_from_zero(agreeing, N, p):
    """Returns the index of the last sample, which is one less than how many were drawn."""
    best = 0
    for index, count in enumerate(agreeing):
        best = max(best, count)
        if index + 1 >= required_iterations(p, best / N, 2):
            return index
    return len(agreeing)


def samples_three(agreeing, N, p):
    """Asks for samples of three points."""
    best = 0
    for drawn, count in enumerate(agreeing, start=1):
        best = max(best, count)
        if drawn >= required_iterations(p, best / N, 3):
            return drawn
    return len(agreeing)


def never_stops(agreeing, N, p):
    """Draws all samples."""
    return len(agreeing)


def counts_outliers(offsets, threshold):
    """Every point outside costs one threshold squared, every point inside nothing."""
    return float((np.abs(offsets) > threshold).sum() * threshold**2)


def forgets_to_cap(offsets, threshold):
    """The sum of squares over all points: least squares."""
    return float((np.asarray(offsets) ** 2).sum())


def leaves_outliers_out(offsets, threshold):
    """Only the points within the threshold cost anything."""
    offsets = np.asarray(offsets)
    return float((offsets[np.abs(offsets) <= threshold] ** 2).sum())


def caps_at_the_threshold(offsets, threshold):
    """Caps the square at the threshold, not at its square."""
    return float(np.minimum(np.asarray(offsets) ** 2, threshold).sum())


def does_not_square(offsets, threshold):
    """Adds up distances, capped at the threshold."""
    return float(np.minimum(np.abs(offsets), threshold).sum())


def keeps_the_sign(offsets, threshold):
    """Caps signed distances, so that far points on one side cost their whole square."""
    return float((np.minimum(offsets, threshold) ** 2).sum())
