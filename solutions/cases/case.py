"""What a case is: the arguments of one call, and a ``name`` that says what kind of input it is."""

from typing import Any

import numpy as np

Value = Any  # what a reference or a student's function gave; the student's may be anything
Case = dict[str, Value]


def seed_of(rng: np.random.Generator) -> dict[str, int]:
    """Return the argument that arrives as a generator of random numbers."""
    return {"rng": int(rng.integers(2**31))}


def real(value: Value) -> float:
    """Return a number as a float.

    Raises:
        TypeError: if it is complex; NumPy would drop its imaginary part with a warning.
        ValueError: if it is no number.
        OverflowError: if it is too large for a float.
    """
    return float(real_numbers(value).reshape(()))


def real_numbers(value: Value) -> np.ndarray:
    """Return numbers as an array of floats, of the shape that they have.

    Raises:
        TypeError: if some are complex.
        ValueError: if they are no numbers.
        OverflowError: if one is too large for a float.
    """
    if np.iscomplexobj(value):
        raise TypeError("complex numbers, where real ones are asked for")
    return np.asarray(value, dtype=float)
