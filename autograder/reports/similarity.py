"""Pairs of submissions whose code is suspiciously alike, whatever their variables are called.

Winnowing (Schleimer, Wilkerson, Aiken: "Winnowing: local algorithms for document fingerprinting",
SIGMOD 2003), as in MOSS: of every ``WINDOW`` neighbouring runs of ``LENGTH`` tokens one is kept as
a fingerprint, so every run of at least ``WINDOW + LENGTH - 1`` equal tokens is noticed. Tokens are
taken without names, numbers, comments and layout. What the handout gave to everybody, what a large
part of the class shares anyway, and functions too short to tell anything do not count. Students are
compared with each other and with what is public: the solved notebooks and the references. A pair is
a reason to read both, no verdict.
"""

from __future__ import annotations

import ast
import io
import keyword
import tokenize
import zlib
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

LENGTH = 20  # tokens in a run, about two lines
WINDOW = 8
COMMON_SHARE = 0.2  # of the class; what more students have is how one does it
SHORT = 40  # tokens of a function, below which there is hardly another way to write it
FEWEST = 8  # fingerprints of a student's own, below which nothing can be said
_SKIPPED = frozenset(
    {tokenize.COMMENT, tokenize.NL, tokenize.ENCODING, tokenize.ENDMARKER, tokenize.NEWLINE}
)


@dataclass(frozen=True)
class Pair:
    """Two students, or a student and a public source, whose code is alike.

    ``share`` is that of the one whose own code is shorter, or of the student; ``first_share`` and
    ``second_share`` are how much of each one's own work the other has too (None for a public
    source), and ``fingerprints`` how many places that are. ``lines`` are one such place in each.
    """

    first: str
    second: str
    share: float
    fingerprints: int
    lines: tuple[str, str]
    first_share: float = 0.0
    second_share: float | None = None


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


def similar_pairs(
    students: Mapping[str, Code],
    handout: Code,
    least: float = 0.5,
    progress: Callable[[], None] = lambda: None,
    public: Mapping[str, Code] | None = None,
) -> list[Pair]:
    """The pairs that share at least ``least`` of the shorter one's own code, most alike first.

    With a source of ``public`` it is that share of the student's own code.
    """
    owners = Counter(mark for code in students.values() for mark in code.places)
    # Two may always share something, however small the class is.
    common = max(2, COMMON_SHARE * len(students))
    own = {
        student: {
            mark for mark in code.places if mark not in handout.places and owners[mark] <= common
        }
        for student, code in students.items()
    }
    by_mark: dict[int, list[str]] = {}
    for student, marks in own.items():
        for mark in marks:
            by_mark.setdefault(mark, []).append(student)
    shared: Counter[tuple[str, str]] = Counter()
    example: dict[tuple[str, str], int] = {}
    for student in sorted(own):
        for mark in own[student]:
            for other in by_mark[mark]:
                if student < other:
                    shared[student, other] += 1
                    example.setdefault((student, other), mark)
        progress()
    pairs = []
    for (first, second), count in shared.items():
        shorter = min(len(own[first]), len(own[second]))
        if shorter >= FEWEST and count >= least * shorter:
            mark = example[first, second]
            lines = (students[first].places[mark], students[second].places[mark])
            shares = count / len(own[first]), count / len(own[second])
            pairs.append(Pair(first, second, count / shorter, count, lines, *shares))
    for student, marks in own.items():
        for name, source in (public or {}).items():
            both = marks & source.places.keys()
            if len(marks) >= FEWEST and len(both) >= least * len(marks):
                share, mark = len(both) / len(marks), min(both)
                lines = (students[student].places[mark], source.places[mark])
                pairs.append(Pair(student, name, share, len(both), lines, share))
    return sorted(pairs, key=lambda pair: (-pair.share, -pair.fingerprints, pair.first))


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


def handout_cells(notebooks: Sequence[Mapping[str, object]]) -> list[str]:
    """The code cells of the untouched notebooks, as parsed from their JSON."""
    cells = []
    for notebook in notebooks:
        entries = notebook.get("cells", [])
        assert isinstance(entries, list)
        cells += ["".join(cell["source"]) for cell in entries if cell.get("cell_type") == "code"]
    return cells
