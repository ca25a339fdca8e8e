"""A random generator that counts how many numbers and how many samples it was asked for.

Whether a function draws as many samples as it was told cannot be seen from a good result: a
fixed number of draws is usually enough. The count tells. How many numbers a sample takes differs
between right ways to draw one, so that their count cannot tell twice as many samples from as many
that take twice the numbers. But who asks for so many different entries at once asks for a sample.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable

import numpy as np

from autograder.exchange.messages import Value


class CountedDraws(np.random.Generator):
    """The numbers of ``np.random.default_rng(seed)``, counted in ``drawn``."""

    def __init__(self, seed: int) -> None:
        super().__init__(np.random.PCG64(seed))
        self.drawn = 0
        self._calls: Counter[int] = Counter()  # by the size of the sample; 0 is no sample
        self._depth = 0

    @property
    def sampled(self) -> tuple[int, int] | None:
        """The size of the samples and their number, if nothing but such samples was drawn."""
        if len(self._calls) != 1:
            return None
        ((size, count),) = self._calls.items()
        return (size, count) if size else None


def _counted(name: str) -> Callable[..., object]:
    method = getattr(np.random.Generator, name)

    def draw(self: CountedDraws, *args: Value, **kwargs: Value) -> Value:
        before = self.drawn
        self._depth += 1  # a method calls others: `permutation` calls `shuffle`
        try:
            numbers = method(self, *args, **kwargs)
        finally:
            self._depth -= 1
        # `shuffle` returns nothing and changes its argument.
        given = numbers if numbers is not None else args[0] if args else kwargs["x"]
        # Slow functions of NumPy only where they are needed: samples are drawn by the ten thousand.
        self.drawn = before + (given.size if isinstance(given, np.ndarray) else np.size(given))
        if not self._depth:
            self._calls[_size_of_sample(*args, **kwargs) if name == "choice" else 0] += 1
        return numbers

    draw.__name__, draw.__doc__ = name, method.__doc__
    return draw


def _size_of_sample(
    a: Value, size: Value = None, replace: bool = True, *_: Value, **__: Value
) -> int:
    """How many different entries one call of ``choice`` gives; 0 if they may be equal."""
    if replace or size is None:
        return 0
    return size if isinstance(size, int) else int(np.prod(size))


for _name in vars(np.random.Generator):
    # Children of `spawn` draw for themselves, and nobody counts.
    if not _name.startswith("_") and _name not in ("bit_generator", "spawn"):
        setattr(CountedDraws, _name, _counted(_name))
