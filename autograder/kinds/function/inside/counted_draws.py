"""A random generator that counts how many numbers and how many samples it was asked for.

Whether a function draws as many samples as it was told cannot be seen from a good result: a
fixed number of draws is usually enough. The count tells. How many numbers a sample takes differs
between right ways to draw one, so that their count cannot tell twice as many samples from as many
that take twice the numbers. But who asks for so many different entries at once asks for a sample.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from autograder.exchange.messages import Value


@dataclass
class _Count:
    """What was drawn with a generator and with all that it spawned."""

    numbers: int = 0
    calls: Counter[int] = field(default_factory=Counter)  # by the size of the sample; 0 is none
    depth: int = 0


class CountedDraws(np.random.Generator):
    """The numbers of ``np.random.default_rng(seed)``, counted in ``drawn``."""

    def __init__(self, seed: int | np.random.BitGenerator, count: _Count | None = None) -> None:
        source = seed if isinstance(seed, np.random.BitGenerator) else np.random.PCG64(seed)
        super().__init__(source)
        self._count = count or _Count()

    @property
    def drawn(self) -> int:
        """How many numbers were drawn."""
        return self._count.numbers

    @property
    def sampled(self) -> tuple[int, int] | None:
        """The size of the samples and their number, if nothing but such samples was drawn."""
        if len(self._count.calls) != 1:
            return None
        ((size, count),) = self._count.calls.items()
        return (size, count) if size else None

    def spawn(self, n_children: int) -> list[CountedDraws]:  # type: ignore[override]
        """Generators that are this one's children; what they draw counts as drawn with it."""
        sources = self.bit_generator.seed_seq.spawn(n_children)  # type: ignore[attr-defined]
        return [CountedDraws(np.random.PCG64(source), self._count) for source in sources]


def _counted(name: str) -> Callable[..., object]:
    method = getattr(np.random.Generator, name)

    def draw(self: CountedDraws, *args: Value, **kwargs: Value) -> Value:
        count = self._count
        before = count.numbers
        count.depth += 1  # a method calls others: `permutation` calls `shuffle`
        try:
            numbers = method(self, *args, **kwargs)
        finally:
            count.depth -= 1
        # `shuffle` returns nothing and changes its argument.
        given = numbers if numbers is not None else args[0] if args else kwargs["x"]
        # Slow functions of NumPy only where they are needed: samples are drawn by the ten thousand.
        count.numbers = before + (given.size if isinstance(given, np.ndarray) else np.size(given))
        if not count.depth:
            count.calls[_size_of_sample(*args, **kwargs) if name == "choice" else 0] += 1
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
    if not _name.startswith("_") and _name not in ("bit_generator", "spawn"):
        setattr(CountedDraws, _name, _counted(_name))
