"""A cell of a solved notebook that raised: where it stands in the master, and what to do."""

from __future__ import annotations

import re
from typing import Any

from autograder.authoring.masters import Master

_LINE = re.compile(r"Cell In\s?\[\d+\], line (\d+)|File <ipython-input[^>]*>:(\d+)")
_COLORS = re.compile(r"\x1b\[[0-9;]*m")
_NO_MODULE = re.compile(r"No module named '([\w.]+)'")
_OWN = ("data", "notebooks", "solutions")


def raised(master: Master, cell: Any, question: str | None) -> str:
    """One sentence for an executed cell that holds an error.

    ``question`` is the id of the exercise whose solved cell or check it is, if it is one.
    """
    error = next(output for output in cell.outputs if output.output_type == "error")
    said = f"{error.ename}: {error.evalue}".splitlines()[0].rstrip(".: ")
    cure = ""
    if (missing := _NO_MODULE.search(said)) and missing[1].partition(".")[0] not in _OWN:
        cure = (
            f"; install {missing[1]}, and name it among the dependencies in pyproject.toml, "
            "so that students have it too"
        )
    if question is not None:
        return f"The solved cell of {question} in {master.path.name} raises {said}{cure}."
    lines = cell.source.splitlines()
    number = min(_line_in_cell("\n".join(error.traceback)), len(lines))
    return (
        f"{master.where(cell.source, number - 1)} raises {said}{cure}: {lines[number - 1].strip()}"
    )


def _line_in_cell(traceback: str) -> int:
    found = _LINE.search(_COLORS.sub("", traceback))
    return int(found[1] or found[2]) if found else 1
