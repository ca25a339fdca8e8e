"""Derivatives and antiderivatives of the right formula, by small steps at the hidden points."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from autograder.kinds.formula import evaluate_formula

_STEP = 1e-3
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(20)
Points = Mapping[str, NDArray[np.float64]]
Of = Callable[[str, Points], NDArray[Any] | None]


def slopes(
    of: Of, formula: str, symbols: Sequence[str], points: Points
) -> Iterator[tuple[str, str, NDArray[Any]]]:
    """The derivative and the antiderivative in each symbol: name, what it looks like, values.

    A derivative is right to about nine digits. An antiderivative is zero where its symbol is.
    """
    for symbol in symbols:
        around = [
            of(formula, {**points, symbol: points[symbol] + step * _STEP})
            for step in (-2, -1, 1, 2)
        ]
        if any(values is None for values in around):
            continue
        a, b, c, d = (np.asarray(values) for values in around)
        with np.errstate(all="ignore"):
            slope = (a - 8 * b + 8 * c - d) / (12 * _STEP)
        words = f"this is the derivative in {symbol} of what is asked for: one time too many"
        yield f"differentiated once more in {symbol}", words, slope
        area = np.zeros(len(points[symbol]))
        for node, weight in zip(_NODES, _WEIGHTS, strict=True):
            at = {**points, symbol: points[symbol] * (node + 1) / 2}
            area = area + weight / 2 * np.asarray(evaluate_formula(formula, at))
        words = f"it was not differentiated in {symbol}, or integrated instead"
        yield f"not differentiated in {symbol}", words, area * points[symbol]
