"""Tables as spreadsheets and learning systems export them, in any encoding."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Sequence
from pathlib import Path

from autograder.errors import CourseError

_LARGEST = 64 * 2**20
_WITHIN_WORDS = re.compile(r"(?<=([^\W\d_]))(?=([^\x00-\x7f])(.?))", re.DOTALL)
_SEPARATORS = (",", ";", "\t")


def read_text(path: Path) -> str:
    """The text of a file: UTF-8 or UTF-16 with or without a mark, else of Windows or a Mac.

    Raises:
        CourseError: if there is no such file or it cannot be read.
    """
    try:
        with path.open("rb") as file:
            data = file.read(_LARGEST)
    except FileNotFoundError:
        raise CourseError(f"There is no class list at {path}; check the name.") from None
    except OSError as error:
        raise CourseError(f"{path} cannot be read: {error.strerror or error}.") from None
    return decode(data)


def decode(data: bytes) -> str:
    """The text in bytes whose encoding nobody says."""
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return data.decode("utf-16", "replace")
    half = data[: 400 // 2 * 2]
    if half.count(0) > len(half) // 4:  # UTF-16 without a mark: every other byte of English is 0
        return data.decode("utf-16-le" if half[1::2].count(0) > half[::2].count(0) else "utf-16-be")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        windows, mac = data.decode("cp1252", "replace"), data.decode("mac-roman")
        # What Excel on a Mac writes, if Windows' letters make nonsense of it.
        return mac if _nonsense(windows) > _nonsense(mac) else windows


def _nonsense(text: str) -> int:
    """How often a sign stands within a word, or a capital behind a small letter: MŸller, Gro§."""
    count = text.count("�")
    for found in _WITHIN_WORDS.finditer(text):
        before, sign, after = found.groups()
        count += not sign.isalpha() if after.isalpha() or sign == "§" else 0
        count += sign.isupper() and (before.islower() or after.islower())
    return count


def read_rows(text: str) -> list[list[str]]:
    """The rows of a table that have something in them, with the separator that its header has."""
    text = text.removeprefix("\ufeff")
    first, _, rest = text.partition("\n")
    separator = ","
    if first.strip().lower().startswith("sep="):  # what Excel is told
        separator, text = first.strip()[4:5] or ",", rest
        first = rest.partition("\n")[0]
    else:
        separator = max(_SEPARATORS, key=first.count)
    csv.field_size_limit(2**20)
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator)
    return [[undefused(cell.strip()) for cell in row] for row in reader if any(map(str.strip, row))]


def undefused(cell: str) -> str:
    """A cell without the quote that keeps spreadsheets from taking it for a formula."""
    return cell[1:] if cell[:1] == "'" and cell[1:2] in tuple("=+-@") else cell


def column(header: Sequence[str], *names: str) -> int | None:
    """The first column with one of these names; upper and lower case do not matter."""
    plain = [" ".join(cell.casefold().replace("_", " ").split()) for cell in header]
    for name in names:
        if name in plain:
            return plain.index(name)
    return None
