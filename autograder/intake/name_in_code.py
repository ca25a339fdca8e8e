"""The name in the line ``me("...")`` of a notebook's code, where no responses came along."""

from __future__ import annotations

import re
from collections.abc import Iterable

from autograder.exchange.identity import clean

_SAID = re.compile(
    r"""^me\([ ]*(?: "([^"\\\n]+)" | '([^'\\\n]+)' | (\d+) )[ ]*\)[ ]*(?:\#.*|;)?$""", re.M | re.X
)


def said_in_code(cells: Iterable[str]) -> str:
    """The name or number in the last line ``me("...")`` of some cells; empty if there is none.

    It stands in for what was kept with the responses, where only a notebook was handed in.
    """
    said = [group for cell in cells for groups in _SAID.findall(cell) for group in groups if group]
    return clean(said[-1]) if said else ""
