"""A random generator that counts how many numbers it was asked for.

Whether a function draws as many samples as it was told cannot be seen from a good result: a
fixed number of draws is usually enough. The count tells.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from autograder.exchange.messages import Value


class CountedDraws(np.random.Generator):
    """The numbers of ``np.random.default_rng(seed)``, counted in ``drawn``."""

    def __init__(self, seed: int) -> None:
        super().__init__(np.random.PCG64(seed))
        self.drawn = 0


def _counted(name: str) -> Callable[..., object]:
    method = getattr(np.random.Generator, name)

    def draw(self: CountedDraws, *args: Value, **kwargs: Value) -> Value:
        before = self.drawn
        numbers = method(self, *args, **kwargs)
        # `shuffle` returns nothing and changes its argument; `permutation` calls `shuffle`.
        self.drawn = before + np.size(args[0] if numbers is None and args else numbers)
        return numbers

    draw.__name__, draw.__doc__ = name, method.__doc__
    return draw


for _name in vars(np.random.Generator):
    # Children of `spawn` draw for themselves, and nobody counts.
    if not _name.startswith("_") and _name not in ("bit_generator", "spawn"):
        setattr(CountedDraws, _name, _counted(_name))
