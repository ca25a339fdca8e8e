"""The line of a file that a field stands in, for errors that an author can click on."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator

Path = tuple[str | int, ...]

_HEADER = re.compile(r"\s*(\[\[?)(.+?)\]\]?\s*(#.*)?$")
_TEXTS = re.compile(r""""(?:[^"\\]|\\.)*"|'[^']*'""")
_KEY = re.compile(
    r"\s*((?:[\w-]+|\"[^\"]*\"|'[^']*')(?:\s*\.\s*(?:[\w-]+|\"[^\"]*\"|'[^']*'))*)\s*="
)


def line_of(text: str, path: Path) -> int | None:
    """The line, counted from 1, of the field at ``path`` in a TOML text, or of what it is part of.

    ``("question", 2, "title")`` is the title of the third ``[[question]]``. The line of the longest
    beginning of the path that has one is given, and None if there is none. Where only parts of the
    field begin a line, as those of a list of ``[[tables]]``, it is the line of the first of them.
    """
    best, known = None, 0
    for number, place in _places(text):
        shared = _shared(place, path)
        if shared in (len(place), len(path)) and shared > known:
            best, known = number, shared
    return best


def _shared(place: Path, path: Path) -> int:
    return next(
        (i for i, (a, b) in enumerate(zip(place, path, strict=False)) if a != b),
        min(len(place), len(path)),
    )


def _places(text: str) -> Iterator[tuple[int, Path]]:
    """Each line that begins a table or a field, with the path of what begins there."""
    counts: dict[Path, int] = {}
    table: Path = ()
    closing = ""  # what ends the text of several lines that we are inside of
    entries: Path | None = None  # the list of several lines that we are inside of
    entry, depth = 0, 0
    for number, line in enumerate(text.splitlines(), 1):
        if closing:
            if closing in line:
                closing = ""
            continue
        if entries is not None:
            if depth == 1 and line.strip()[:1] not in ("", "#", "]"):
                yield number, (*entries, entry)
                entry += 1
            depth += _opened(line)
            entries = entries if depth > 0 else None
            continue
        if header := _HEADER.match(line):
            names = _names(header[2])
            if names is None:
                continue
            table = _counted(names, counts, header[1] == "[[")
            yield number, table
        elif key := _KEY.match(line):
            names = _names(key[1])
            if names is not None:
                yield number, table + names
                if line[key.end() :].partition("#")[0].strip() == "[":
                    entries, entry, depth = table + names, 0, 1
                    continue
        for quotes in ('"""', "'''"):
            if line.count(quotes) % 2:
                closing = quotes


def _opened(line: str) -> int:
    """How many more brackets a line opens than it closes, outside of texts and of a comment."""
    bare = _TEXTS.sub("", line).partition("#")[0]
    return sum(bare.count(sign) for sign in "[{") - sum(bare.count(sign) for sign in "]}")


def _names(dotted: str) -> Path | None:
    """The parts of a dotted name, as TOML reads them."""
    try:
        inner: object = tomllib.loads(f"{dotted} = 0")
    except tomllib.TOMLDecodeError:
        return None  # a line of something else, such as a list of several lines
    names = []
    while isinstance(inner, dict):
        ((name, inner),) = inner.items()
        names.append(name)
    return tuple(names)


def _counted(names: Path, counts: dict[Path, int], begins: bool) -> Path:
    """The path of a table, with the number of each list entry that it is in."""
    path: Path = ()
    for position, name in enumerate(names, 1):
        path += (name,)
        if begins and position == len(names):
            counts[path] = counts.get(path, -1) + 1
        if path in counts:
            path += (counts[path],)
    return path
