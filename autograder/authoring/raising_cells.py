"""A cell of a solved notebook that raised: where it stands in the master, and what to do."""

from __future__ import annotations

import re
import tomllib
from typing import Any

from autograder.authoring.bundle_pyproject import distribution
from autograder.authoring.master import Master
from autograder.course.own_code import OWN

# As one IPython after the other has said it; the oldest marks the line by an arrow.
_LINE = re.compile(
    r"Cell In\s?\[\d+\], line (\d+)|File <ipython-input[^>]*>:(\d+)"
    r"|ipykernel_\d+/\d+\.py\"?, line (\d+)|ipykernel_\d+/\d+\.py in (?:.*\n)+?-+> (\d+)"
)
_COLORS = re.compile(r"\x1b\[[0-9;]*m")
_NO_MODULE = re.compile(r"No module named '([\w.]+)'")


def raised(master: Master, cell: Any, question: str | None) -> str:
    """One sentence for an executed cell that holds an error.

    ``question`` is the id of the exercise whose solved cell or check it is, if it is one.
    """
    error = next(output for output in cell.outputs if output.output_type == "error")
    # What newer Pythons raise of code that only lacks its end is a SyntaxError to everybody else.
    name = error.ename.replace("_IncompleteInputError", "SyntaxError")
    said = f"{name}: {error.evalue}".splitlines()[0].rstrip(".: ")
    missing = _NO_MODULE.search(said)
    cure = _how_to_have(missing[1].partition(".")[0], master) if missing else ""
    if question is not None:
        return f"The solved cell of {question} in {master.path.name} raises {said}{cure}."
    lines = cell.source.splitlines()
    number = min(_line_in_cell("\n".join(error.traceback)), len(lines))
    where = master.where(cell.source, number - 1)
    return f"{where} raises {said} ({lines[number - 1].strip()}){cure}."


def _line_in_cell(traceback: str) -> int:
    found = _LINE.search(_COLORS.sub("", traceback))
    return int(next(filter(None, found.groups()))) if found else 1


def _how_to_have(module: str, master: Master) -> str:
    """What to do about a module that is not here; nothing for one of the course's own."""
    if module in OWN:
        return ""
    try:
        text = (master.path.parents[2] / "pyproject.toml").read_text(encoding="utf-8")
        needed = tomllib.loads(text)["project"]["dependencies"]
    except (OSError, tomllib.TOMLDecodeError, KeyError):
        needed = []
    if module in {distribution(entry) for entry in needed}:
        return '; the course needs it: type pip install -e ".[author,lab]" in its folder'
    return (
        f"; install {module}, and name it among the dependencies in pyproject.toml, "
        "so that students have it too"
    )
