"""Text of anybody's that is safe to show: without control characters and changes of direction."""

from __future__ import annotations

# Families of emoji, Persian and Indic names are written with them; they turn nothing round.
JOINERS = "\u200c\u200d"


def printable(text: str, instead: str, keep: str = "") -> str:
    """The text with ``instead`` in place of what does not print, except what is to ``keep``.

    >>> printable("a\\x1b[31mb\\n", "?")
    'a?[31mb?'
    """
    return "".join(c if c.isprintable() or c in JOINERS or c in keep else instead for c in text)
