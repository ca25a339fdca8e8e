"""What a value becomes when it is unpacked: lists and numbers, which its bytes do not show.

An array of 2**28 rows without columns has no bytes at all and becomes 268 million lists. Whoever
takes a value from an untrusted process counts here first, before anything else touches it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

BYTES_A_NUMBER = 8  # an int8 costs as much as a float as soon as it is compared with one
BYTES_A_LIST = 64


def unpacked_bytes(shape: Sequence[int], item_size: int) -> int:
    """The least that an array of this shape takes as NumPy's floats or as nested lists.

    >>> unpacked_bytes((1000, 3), 8)
    88000
    >>> unpacked_bytes((1000, 0), 8)
    64000
    """
    lists, rows = 0, 1
    for length in shape[:-1]:
        rows *= length
        lists += rows
    return math.prod(shape) * max(item_size, BYTES_A_NUMBER) + lists * BYTES_A_LIST


def count_parts(value: object, most: int) -> int:
    """How many lists, dictionaries and values stand in a JSON value; it stops above ``most``."""
    left, count = [value], 0
    while left and count <= most:
        item = left.pop()
        count += 1
        if isinstance(item, list | tuple):
            left += item
        elif isinstance(item, dict):
            left += item.values()
    return count
