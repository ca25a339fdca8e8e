"""Notices work that was run but not saved: the file on the disk is what is handed in.

Cells are known by their ids where the front end sends those that it saves, as JupyterLab does.
Visual Studio Code sends addresses of its own instead, other front ends send nothing: there the
sources of what ran are compared with the saved ones. Whatever was run before the file was saved
last has been saved with it, so only what ran since then counts. No clock decides that: every run
remembers which version of the file it met.
"""

from __future__ import annotations

import ast
import json
import os
import re
import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import Protocol
from urllib.parse import unquote, urlsplit

from autograder.errors import CourseError
from autograder.exchange.building import BUILDING
from autograder.language import N_, _
from autograder.student.course_path import (
    course_of_notebook,
    notebook_folder,
    notebooks_folder,
)
from autograder.student.frontend import VSCODE_FILE, current_cell, deleted_cells, running_shell

HOW = N_("Save the notebook (Ctrl+S, on a Mac ⌘S) and run `submit()` again")
_VSCODE_CELL = "vscode-notebook-cell"
# What a student calls to hand in; a cell with nothing else is no work.
_HAND_IN = ("submit", "progress", "me")
_LINE_MAGIC = re.compile(r"^\s*%+(time|timeit)\b", re.MULTILINE)


@dataclass(frozen=True)
class Run:
    """What a cell was when it was run last."""

    cell: str | None  # as the front end calls it
    source: str
    saved: dict[str, int]  # the versions of the notebooks on the disk at that time, by their names


@dataclass(frozen=True)
class Saved:
    """A notebook as it is on the disk."""

    name: str
    version: int
    by_id: dict[str, str]
    sources: frozenset[str]

    def knows(self, run: Run) -> bool:
        """Whether the run is of one of its cells, as far as that can be seen."""
        return run.cell in self.by_id or run.source in self.sources


_runs: dict[str, Run] = {}  # the last run of each cell, or of each source where cells have no id


class CellInfo(Protocol):
    """What IPython tells of a cell before it runs it."""

    raw_cell: str
    store_history: bool


def watch() -> None:
    """Remember from now on what every cell was when it was run, this one included."""
    shell = running_shell()
    if shell is None or not hasattr(shell, "kernel") or os.environ.get(BUILDING) == "1":
        return
    shell.events.register("pre_run_cell", _remember)
    running = getattr(getattr(shell, "history_manager", None), "input_hist_raw", None)
    if running and running[-1]:
        remember(current_cell(), running[-1])


def _remember(info: CellInfo) -> None:
    for cell in deleted_cells():
        _runs.pop(cell, None)
    if info.store_history:
        remember(getattr(info, "cell_id", None) or current_cell(), info.raw_cell)


def remember(cell: str | None, source: str, folder: Path | None = None) -> None:
    """Note that a cell with this source is run now, in the folder of its notebook."""
    versions = {path.name: version for path, version in _notebooks(folder or _watched())}
    source = _as_compared(source)
    _runs.pop(cell or source, None)  # the last run comes last
    _runs[cell or source] = Run(cell, source, versions)


def _watched() -> Path:
    """The folder whose notebooks are handed in."""
    try:
        return notebooks_folder(course_of_notebook())
    except CourseError:
        return notebook_folder()


def _as_compared(source: str) -> str:
    """A source without what editors change when they save: line ends, and blanks before them."""
    return "\n".join(line.rstrip() for line in source.splitlines()).strip()


def unsaved_work(folder: Path) -> str:
    """What to tell a student about work that the notebooks in a folder lack; nothing if none is.

    Only the notebook that is running can be judged. Which one that is, Visual Studio Code says;
    otherwise it is seen from the cells, since a kernel does not know it for certain.
    """
    runs = list(_runs.values())
    if not runs:
        return ""
    notebooks = [saved for path, version in _notebooks(folder) if (saved := _read(path, version))]
    running = _running(notebooks, runs)
    if running is None:
        return _(
            "Whether your notebook is saved cannot be seen from here: your editor does not say "
            "where it is. {how}, unless you have just saved it."
        ).format(how=_(HOW))
    since = [run for run in runs if run.saved.get(running.name, running.version) == running.version]
    if any(run.cell in running.by_id and running.by_id[run.cell] != run.source for run in since):
        sentence = _("{file} differs from what you ran last. {how}.")
        return sentence.format(file=running.name, how=_(HOW))
    lost = [run for run in since if not running.knows(run) and not hands_in(run.source)]
    if lost:
        line = lost[-1].source.splitlines()[0].replace("`", "'")
        line = line if len(line) <= 60 else line[:59] + "…"
        return _(
            "{file} is saved without code that you ran, such as `{line}`. {how}, unless you have "
            "taken it out."
        ).format(file=running.name, line=line, how=_(HOW))
    return ""


def hands_in(source: str) -> bool:
    """Whether code only hands in, so that nothing is lost with it."""
    try:
        statements = ast.parse(_LINE_MAGIC.sub("", source).strip()).body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return False
    return all(_is_to_hand_in(statement) for statement in statements)


def _is_to_hand_in(statement: ast.stmt) -> bool:
    match statement:
        case ast.Import(names=names):
            return all(name.name.split(".")[0] == "autograder" for name in names)
        case ast.ImportFrom(module=module):
            return (module or "").split(".")[0] == "autograder"
        case ast.Expr(ast.Call(ast.Name(id=name) | ast.Attribute(ast.Name(), attr=name))):
            return name in _HAND_IN
    return False


def _running(notebooks: list[Saved], runs: list[Run]) -> Saved | None:
    """The notebook that is running, or None if that cannot be told."""
    by_name = {_composed(saved.name): saved for saved in notebooks}
    told = _name_in_vscode(runs)
    if told is not None:
        return by_name.get(_composed(told))
    session = PurePosixPath(os.environ.get("JPY_SESSION_NAME", "").replace("\\", "/")).name
    found = [(sum(saved.knows(run) for run in runs), saved) for saved in notebooks]
    found = [(count, saved) for count, saved in found if count]
    if found:
        return max(found, key=lambda entry: (entry[0], entry[1].name == session))[1]
    return by_name.get(_composed(session))


def _composed(name: str) -> str:
    """A file's name with each accented letter as one character: macOS keeps two."""
    return unicodedata.normalize("NFC", name)


def _name_in_vscode(runs: list[Run]) -> str | None:
    for run in reversed(runs):
        address = urlsplit(run.cell or "")
        if address.scheme == _VSCODE_CELL:
            return PurePosixPath(unquote(address.path)).name
    shell = running_shell()
    file = shell.user_ns.get(VSCODE_FILE) if shell is not None else None
    return PurePosixPath(file.replace("\\", "/")).name if isinstance(file, str) else None


def _notebooks(folder: Path) -> Iterator[tuple[Path, int]]:
    """The notebooks of a folder, each with a number that changes when it is saved."""
    for path in sorted(folder.glob("*.ipynb")):
        try:
            yield path, path.stat().st_mtime_ns
        except OSError:
            continue  # taken away in the meantime


def _read(path: Path, version: int) -> Saved | None:
    try:
        cells = json.loads(path.read_text(encoding="utf-8-sig"))["cells"]
        code = [cell for cell in cells if cell.get("cell_type") == "code"]
        sources = [_as_compared("".join(cell.get("source", ""))) for cell in code]
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return None
    by_id = {cell["id"]: source for cell, source in zip(code, sources, strict=True) if "id" in cell}
    return Saved(path.name, version, by_id, frozenset(sources))
