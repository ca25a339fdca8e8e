"""Correlations of a student's points for one question with those for all others."""

from __future__ import annotations

import numpy as np

FEWEST = 10  # below that, a correlation is chance


class Together:
    """Pearson's correlations of ``count`` pairs of numbers, gathered by Welford's method."""

    def __init__(self, count: int) -> None:
        self._seen = 0
        # In the rows: the first of each pair, the second.
        self._mean, self._squares = np.zeros((2, count)), np.zeros((2, count))
        self._products = np.zeros(count)
        self._low, self._high = np.full((2, count), np.inf), np.full((2, count), -np.inf)

    def add(self, first: np.ndarray, second: np.ndarray) -> None:
        """Take in the next of each pair, arrays of ``count`` numbers."""
        pair = np.stack([first, second])
        self._seen += 1
        before = pair - self._mean
        self._mean += before / self._seen
        self._squares += before * (pair - self._mean)
        self._products += before[0] * (pair[1] - self._mean[1])
        self._low, self._high = np.minimum(self._low, pair), np.maximum(self._high, pair)

    def correlations(self) -> list[float | None]:
        """One for each pair; None for few values or none that vary."""
        if self._seen < FEWEST:
            return [None] * len(self._products)
        varies = np.min(self._high - self._low, axis=0) > 0
        scale = np.sqrt(self._squares.prod(axis=0))
        return [
            float(np.clip(product / size, -1, 1)) if is_defined and size > 0 else None
            for product, size, is_defined in zip(self._products, scale, varies, strict=True)
        ]
