"""What a case is: the arguments of one call, and a ``name`` that says what kind of input it is."""

from typing import Any

import numpy as np

Value = Any  # what a reference or a student's function gave; the student's may be anything
Case = dict[str, Value]


def seed_of(rng: np.random.Generator) -> dict[str, int]:
    """Return the argument that arrives as a generator of random numbers."""
    return {"rng": int(rng.integers(2**31))}
