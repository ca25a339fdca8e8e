"""Notices work that was run but not saved: the file on the disk is what is handed in."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Protocol

from autograder.student.frontend import running_shell

_run: dict[str, str] = {}  # cell id -> the source that was run last


class CellInfo(Protocol):
    """What IPython tells of a cell before it runs it."""

    raw_cell: str
    store_history: bool


def watch() -> None:
    """Remember from now on what every cell was when it was run."""
    shell = running_shell()
    if shell is not None and hasattr(shell, "kernel"):
        shell.events.register("pre_run_cell", _remember)


def _remember(info: CellInfo) -> None:
    cell = getattr(info, "cell_id", None)
    if cell is not None and info.store_history:
        _run[cell] = info.raw_cell


def changed_notebook(folder: Path) -> str | None:
    """The name of the running notebook, if a cell that was run differs from the saved one.

    Cells that the file does not hold at all are not counted: they may have been deleted. Which
    notebook is running is seen from its cells, since a kernel does not know it for certain.
    """
    running, most = None, 0
    for path in sorted(folder.glob("*.ipynb")):
        try:
            cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
            saved = {cell.get("id"): "".join(cell.get("source", "")).strip() for cell in cells}
        except (OSError, ValueError, KeyError, TypeError, AttributeError):
            continue
        known = [cell for cell in _run if cell in saved]
        same = sum(saved[cell] == _run[cell].strip() for cell in known)
        if same > most:
            most = same
            running = path.name if same < len(known) else None
    return running
