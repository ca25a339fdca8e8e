"""Other right ways to say when an adaptive RANSAC stops."""

import math

import numpy as np

from solutions.ransac.probabilities import required_iterations


def running_maximum(agreeing, N, p):
    best = np.maximum.accumulate(np.asarray(agreeing, dtype=int))
    needed = np.array([required_iterations(p, share, 2) for share in best / N])
    done = np.flatnonzero(np.arange(1, len(best) + 1) >= needed)
    return done[0] + 1 if len(done) else len(best)


def chance_of_failure(agreeing, N, p):
    w, n = 0.0, 0
    for count in agreeing:
        n += 1
        w = max(w, count / N)
        if (1 - w**2) ** n <= 1 - p:
            break
    return n


def while_loop(agreeing, N, p):
    drawn, best, needed = 0, 0, math.inf
    while drawn < min(needed, len(agreeing)):
        if agreeing[drawn] > best:
            best = agreeing[drawn]
            needed = max(drawn + 1, required_iterations(p, best / N, 2))
        drawn += 1
    return drawn


def generator_expression(agreeing, N, p):
    def enough(n):
        return n >= required_iterations(p, max(agreeing[:n]) / N, 2)

    k = len(agreeing)
    return next((n for n in range(1, k + 1) if enough(n)), k)
