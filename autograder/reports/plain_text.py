"""Output that every terminal takes: what it has no letter for is written in letters it has."""

from __future__ import annotations

import codecs

_INSTEAD = {
    "✓": "+",
    "◐": "~",
    "✗": "x",
    "·": ".",
    "●": "o",
    "○": "-",
    "→": "->",
    "…": "...",
    "–": "-",
    "—": "-",
    "“": '"',
    "”": '"',
    "‘": "'",
    "’": "'",
    "�": "?",
    "×": "x",
    "≥": ">=",
    "≤": "<=",
    " ": " ",
}
NAME = "autograder-plain"


def make_plain(*streams: object) -> None:
    """Let streams of any encoding take any text; a name's letter becomes ``\\u0142``, not an error.

    Windows gives cp1252 to output that is redirected, and a service may have ASCII.
    """
    codecs.register_error(NAME, _replace)
    for stream in streams:
        if stream is not None and hasattr(stream, "reconfigure"):
            stream.reconfigure(errors=NAME)


def _replace(error: UnicodeError) -> tuple[str, int]:
    if not isinstance(error, UnicodeEncodeError):
        raise error
    said = "".join(_INSTEAD.get(c) or _escaped(c) for c in error.object[error.start : error.end])
    return said, error.end


def _escaped(character: str) -> str:
    return character.encode("ascii", "backslashreplace").decode("ascii")
