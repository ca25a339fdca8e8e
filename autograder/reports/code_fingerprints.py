"""Fingerprints of code, whatever its variables are called: runs of tokens, of which some are kept.

Winnowing (Schleimer, Wilkerson, Aiken: "Winnowing: local algorithms for document fingerprinting",
SIGMOD 2003), as in MOSS: of every ``WINDOW`` neighbouring runs of ``LENGTH`` tokens one is kept as
a fingerprint, so every run of at least ``WINDOW + LENGTH - 1`` equal tokens is noticed. Tokens are
taken without names, numbers, comments and layout. Functions too short to tell anything do not
count.
"""

from __future__ import annotations

import ast
import io
import keyword
import tokenize
import zlib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

LENGTH = 20  # tokens in a run, about two lines
WINDOW = 8
SHORT = 40  # tokens of a function, below which there is hardly another way to write it
_SKIPPED = frozenset(
    {tokenize.COMMENT, tokenize.NL, tokenize.ENCODING, tokenize.ENDMARKER, tokenize.NEWLINE}
)


@dataclass(frozen=True)
class Code:
    """A student's fingerprints, each with the first line of the place where it stands."""

    places: Mapping[int, str]


def fingerprints(cells: Iterable[str]) -> Code:
    """The fingerprints of notebook cells; a run of tokens does not cross from cell to cell."""
    places: dict[int, str] = {}
    for cell in map(_without_short_functions, cells):
        tokens = _tokens(cell)
        lines = cell.splitlines()
        texts = [text for text, _ in tokens]
        hashes = [
            zlib.crc32("\x00".join(texts[start : start + LENGTH]).encode("utf-8", "replace"))
            for start in range(len(texts) - LENGTH + 1)
        ]
        for start in range(max(1, len(hashes) - WINDOW + 1)) if hashes else ():
            window = hashes[start : start + WINDOW]
            # The rightmost smallest, so that neighbouring windows choose the same one.
            at = start + max(i for i, value in enumerate(window) if value == min(window))
            line = tokens[at][1] - 1
            places.setdefault(hashes[at], lines[line].strip() if line < len(lines) else "")
    return Code(places)


def _without_short_functions(cell: str) -> str:
    """The cell with blank lines in place of functions that are too short to tell anything."""
    try:
        statements = ast.parse(_without_magics(cell)).body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return cell
    lines = cell.splitlines()
    for statement in statements:
        if isinstance(statement, ast.FunctionDef | ast.AsyncFunctionDef):
            first = min([statement.lineno, *(d.lineno for d in statement.decorator_list)]) - 1
            last = statement.end_lineno or first
            if len(_tokens(_without_docstring(lines[first:last], statement))) < SHORT:
                lines[first:last] = [""] * (last - first)
    return "\n".join(lines)


def _without_docstring(
    lines: Sequence[str], function: ast.FunctionDef | ast.AsyncFunctionDef
) -> str:
    body = function.body[0]
    if ast.get_docstring(function, clean=False) is None:
        return "\n".join(lines)
    start = len(lines) - ((function.end_lineno or 0) - body.lineno) - 1
    end = start + (body.end_lineno or body.lineno) - body.lineno + 1
    return "\n".join([*lines[:start], *lines[end:]])


def _tokens(cell: str) -> list[tuple[str, int]]:
    """Tokens without names, numbers and layout, each with its line; as far as the cell is Python.

    Keywords, and names that are called, keep their text: ``np.linalg.svd`` says more than its dots.
    """
    found: list[tokenize.TokenInfo] = []
    reader = io.StringIO(_without_magics(cell)).readline
    try:
        for token in tokenize.generate_tokens(reader):
            if token.type not in _SKIPPED:
                found.append(token)
    except (tokenize.TokenError, SyntaxError, ValueError):
        pass  # what came before the broken place counts
    tokens = []
    for position, token in enumerate(found):
        text = token.string
        if token.type == tokenize.NAME and not keyword.iskeyword(text):
            attribute = position > 0 and found[position - 1].string == "."
            text = f".{text}" if attribute else "N"
        elif token.type == tokenize.NUMBER:
            text = "0"
        elif token.type == tokenize.STRING:
            text = '""'
        elif token.type in (tokenize.INDENT, tokenize.DEDENT):
            text = tokenize.tok_name[token.type]
        tokens.append((text, token.start[0]))
    return tokens


def _without_magics(cell: str) -> str:
    lines = ["" if line.lstrip().startswith(("%", "!")) else line for line in cell.splitlines()]
    return "\n".join(lines) + "\n"
