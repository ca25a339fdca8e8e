"""What students write for the RANSAC questions, and what goes wrong."""

import math


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
