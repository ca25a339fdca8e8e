"""Other right ways to count iterations."""

import math
from decimal import ROUND_CEILING, Decimal, localcontext
from fractions import Fraction

import numpy as np


def _edges(p, w):
    if p <= 0 or p >= 1 or w < 0 or w > 1:
        raise ValueError("p and w are probabilities")
    return 1 if w == 1 else math.inf if w == 0 else None


def exponentials(p, w, s):
    if not 0 < p < 1 or not 0 <= w <= 1:
        raise ValueError("probabilities")
    if w == 1:
        return 1
    if w == 0:
        raise ValueError("no inliers")
    return math.ceil(math.log1p(-p) / math.log1p(-math.exp(s * math.log(w))))


def one_at_least(p, w, s):
    if not 0 < p < 1 or not 0 <= w <= 1:
        raise ValueError("p or w is out of range")
    if w == 1:
        return 1
    if w == 0:
        return math.inf
    return max(1, math.ceil(math.log1p(-p) / math.log1p(-(w**s))))


def numpy_scalars(p, w, s):
    edge = _edges(p, w)
    return edge or np.ceil(np.log1p(-p) / np.log1p(-(np.float64(w) ** s)))


def sixty_digits(p, w, s):
    edge = _edges(p, w)
    if edge:
        return edge
    with localcontext() as context:
        context.prec = 60
        k = (1 - Decimal(p)).ln() / (1 - Decimal(w) ** s).ln()
        return int(k.to_integral_value(ROUND_CEILING))


def negative_floor(p, w, s):
    edge = _edges(p, w)
    return edge or -math.floor(-math.log(1 - p) / math.log1p(-(w**s)))


def exact_steps_where_that_is_quick(p, w, s):
    edge = _edges(p, w)
    if edge:
        return float(edge)
    if w**s < 0.05:
        return math.ceil(np.log1p(-p) / np.log1p(-math.prod([w] * s)))
    failure, k = Fraction(1), 0
    while failure > 1 - Fraction(p):
        failure, k = failure * (1 - Fraction(w) ** s), k + 1
    return k
