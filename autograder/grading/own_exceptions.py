"""What students are told of their own code's exceptions: from before anything hidden was sent."""

from __future__ import annotations

import re
from collections.abc import Sequence

from autograder.exchange.exception_text import missing_module
from autograder.exchange.messages import Told
from autograder.language import _

LONGEST_CODE = 6000  # characters of a cell that the page of feedback shows


def defining_cell(name: str, cells: Sequence[str]) -> int | None:
    """The last cell that defines a variable or a function, by its place."""
    # No \s: it takes line ends too, and a cell of empty lines would then be searched from each of
    # them to the end, for minutes and with every other thread waiting.
    name = re.escape(name)
    defines = re.compile(
        rf"^[ \t]*((async[ \t]+)?def[ \t]+{name}\b|{name}[ \t]*(:[^=\n]*)?=[^=])", re.MULTILINE
    )
    found = [index for index, cell in enumerate(cells) if defines.search(cell)]
    return found[-1] if found else None


def shown_code(cell: str) -> str:
    """A cell for the page of feedback, cut where it gets too long."""
    code = cell.strip("\n")
    return code if len(code) <= LONGEST_CODE else code[:LONGEST_CODE] + "\n…"


def import_notes(chapter: str, told: Sequence[Told | None]) -> list[str]:
    """A note for each module that a notebook imports and that is not there, with its line."""
    notes = []
    for entry in told:
        if entry and entry["module"]:
            source = f" ({entry['source']})" if entry["source"] else ""
            notes.append(
                _(
                    "{chapter}: {missing}, line {line} of its cell; what needs it did not run. "
                    "Remove the import, or ask for the module."
                ).format(
                    chapter=chapter, missing=f"{missing_module(entry)}{source}", line=entry["line"]
                )
            )
    return list(dict.fromkeys(notes))[:5]
