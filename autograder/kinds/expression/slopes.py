"""Derivatives and antiderivatives of the right formula, by small steps at the hidden points."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from autograder.language import _

_STEP = 1e-3
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(20)
Points = Mapping[str, NDArray[np.float64]]
Of = Callable[[str, Points], np.ndarray | None]


def slopes(
    of: Of, formula: str, symbols: Sequence[str], points: Points
) -> Iterator[tuple[str, str, np.ndarray]]:
    """The derivative and the antiderivative in each symbol: name, what it looks like, values.

    A derivative is right to about nine digits. An antiderivative is zero where its symbol is.
    """
    for symbol in symbols:
        if symbol not in formula:
            continue
        at = points[symbol]

        def beside(values: np.ndarray, symbol: str = symbol) -> np.ndarray | None:
            """The formula where the symbol has each row of values, all in one."""
            many = {name: np.tile(other, len(values)) for name, other in points.items()}
            found = of(formula, {**many, symbol: values.ravel()})
            return None if found is None else found.reshape(values.shape)

        around = beside(at + _STEP * np.array([[-2.0], [-1.0], [1.0], [2.0]]))
        if around is None:
            return
        with np.errstate(all="ignore"):
            slope = (around[0] - 8 * around[1] + 8 * around[2] - around[3]) / (12 * _STEP)
        words = _("this is the derivative in {symbol} of what is asked for: one time too many")
        yield f"differentiated once more in {symbol}", words.format(symbol=symbol), slope
        between = beside(at * (_NODES[:, np.newaxis] + 1) / 2)
        if between is not None:
            area = np.asarray(_WEIGHTS / 2 @ between) * at
            words = _("it was not differentiated in {symbol}, or integrated instead")
            yield f"not differentiated in {symbol}", words.format(symbol=symbol), area
