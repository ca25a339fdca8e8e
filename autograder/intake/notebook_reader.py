"""Reads an untrusted notebook file: its code, and the receipts among its outputs.

Only the standard library is used, and nothing of the notebook is run. A large file is read in a
process of its own under a memory limit, so that one made to exhaust memory stays away from the
grader.
"""

from __future__ import annotations

import gc
import json
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

from autograder.exchange.responses import RECEIPT, keep_response
from autograder.language import N_, _, chosen, use

SUBMITTED = "submitted.txt"  # when `submit()` packed it: a hint, students can change it
LARGE = 4 * 2**20  # bytes; JSON of this size needs at most about 150 MB while it is read
MAX_CELLS = 2000
MAX_CODE = 2 * 2**20  # characters in all code cells together
_CHILD_MEMORY = 2**30
_CHILD_SECONDS = 60
# Without installed packages and without the current folder: only this package is to be found.
_READ = (
    "import sys; sys.path.append(sys.argv[1]); "
    "from autograder.intake.notebook_reader import read_for_parent; read_for_parent(sys.argv[2])"
)
_TOO_LARGE = N_("{name} is too large to be read; clear its outputs and save it again.")


class Unreadable(Exception):
    """A submission, or a part of it, cannot be read; the text is one sentence for the student."""


@dataclass(frozen=True)
class Notebook:
    """What is taken from a notebook: its code cells in order, and its receipts by question id."""

    cells: list[str]
    receipts: dict[str, object] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)


def read_notebook(data: bytes, name: str = "the notebook") -> Notebook:
    """Read the bytes of an ``.ipynb`` file of nbformat 4, or of 3 and 2 with their worksheets.

    Raises:
        Unreadable: if they are no notebook; the sentence says why.
    """
    return _read_large(data, name) if len(data) > LARGE else parse_notebook(data, name)


def parse_notebook(data: bytes, name: str) -> Notebook:
    """Read a notebook in this process.

    Raises:
        Unreadable: as `read_notebook`.
    """
    document = parse_json(data, name)
    if not isinstance(document, dict):
        raise Unreadable(
            _("{name} is not a notebook: it holds {kind} of JSON; save it again.").format(
                name=name, kind=_kind(document)
            )
        )
    sheets = document.get("worksheets")
    if isinstance(document.get("cells"), list):
        cells = document["cells"]
    elif isinstance(sheets, list):
        cells = [
            cell
            for sheet in sheets
            if isinstance(sheet, dict) and isinstance(sheet.get("cells"), list)
            for cell in sheet["cells"]
        ]
    else:
        raise Unreadable(
            _("{name} is not a notebook: it has no list of cells; save it from Jupyter.").format(
                name=name
            )
        )

    sources: list[str] = []
    receipts: dict[str, object] = {}
    notes: list[str] = []
    if document.get("nbformat") in (2, 3):
        sentence = _("{name} is in an old notebook format (nbformat {number}).")
        notes.append(sentence.format(name=name, number=document["nbformat"]))
    for cell in cells:
        if not isinstance(cell, dict):
            sentence = _("{name} holds something that is not a cell; it was left out.")
            notes.append(sentence.format(name=name))
        elif cell.get("cell_type") == "code":
            sources.append(_source(cell))
            receipts |= _receipts(cell)
    if len(sources) > MAX_CELLS:
        sentence = _("{name} has more than {count} code cells.")
        raise Unreadable(sentence.format(name=name, count=MAX_CELLS))
    if sum(map(len, sources)) > MAX_CODE:
        sentence = _("{name} has more than {count} million characters of code.")
        raise Unreadable(sentence.format(name=name, count=MAX_CODE // 2**20))
    return Notebook(sources, receipts, list(dict.fromkeys(notes)))


def parse_json(data: bytes, name: str) -> object:
    """The JSON in untrusted bytes, as UTF-8 or UTF-16 and with or without a byte order mark.

    Raises:
        Unreadable: if it is none.
    """
    if not data.strip():
        sentence = _("{name} is empty; save it again before handing it in.")
        raise Unreadable(sentence.format(name=name))
    try:
        encoding = json.detect_encoding(data)
        text = data.decode(encoding)
    except UnicodeDecodeError:
        sentence = _("{name} is not text; hand in the .ipynb file itself.")
        raise Unreadable(sentence.format(name=name)) from None
    try:
        return json.loads(text)
    except json.JSONDecodeError as error:
        if error.pos >= len(text.rstrip()) - 1 or error.msg.startswith("Unterminated"):
            raise Unreadable(
                _("{name} is cut off after {count} characters; copy or upload it again.").format(
                    name=name, count=len(text)
                )
            ) from None
        raise Unreadable(
            _("{name} is damaged (line {line}: {reason}); save it again.").format(
                name=name, line=error.lineno, reason=error.msg.lower()
            )
        ) from None
    except (RecursionError, ValueError):  # ValueError: an integer of 5,000 digits
        raise Unreadable(
            _("{name} holds data that does not belong in a notebook; save it again.").format(
                name=name
            )
        ) from None


def _source(cell: dict[str, object]) -> str:
    source = cell.get("source", cell.get("input", ""))
    if isinstance(source, list):
        return "".join(line for line in source if isinstance(line, str))
    return source if isinstance(source, str) else ""


def _receipts(cell: dict[str, object]) -> dict[str, object]:
    found: dict[str, object] = {}
    outputs = cell.get("outputs")
    for output in outputs if isinstance(outputs, list) else ():
        data = output.get("data") if isinstance(output, dict) else None
        receipt = data.get(RECEIPT) if isinstance(data, dict) else None
        if isinstance(receipt, dict) and "response" in receipt:
            found |= keep_response(receipt.get("question"), receipt["response"])
    return found


def _kind(document: object) -> str:
    return {list: _("a list"), str: _("a text"), type(None): _("nothing")}.get(
        type(document), _("a number")
    )


def _read_large(data: bytes, name: str) -> Notebook:
    """Read it in a process that may use only so much memory and time."""
    try:
        done = subprocess.run(
            [sys.executable, "-I", "-S", "-c", _READ, str(Path(__file__).parents[2]), chosen()],
            input=data,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            timeout=_CHILD_SECONDS,
            check=False,
        )
        reply = json.loads(done.stdout) if done.returncode == 0 else {}
    except (subprocess.TimeoutExpired, ValueError):
        reply = {}
    if "reason" in reply:
        raise Unreadable(reply["reason"].replace("\0", name))
    if "cells" not in reply:
        raise Unreadable(_(_TOO_LARGE).format(name=name))
    notes = [note.replace("\0", name) for note in reply["notes"]]
    return Notebook(reply["cells"], reply["receipts"], notes)


def read_for_parent(language: str) -> None:
    """Read the notebook on standard input, within a limit, and answer on standard output."""
    use(language)
    gc.disable()  # what JSON gives holds no cycles, and looking for them takes most of the time
    try:
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (_CHILD_MEMORY, _CHILD_MEMORY))
    except ImportError:  # Windows
        pass
    try:
        notebook = parse_notebook(sys.stdin.buffer.read(), "\0")
        reply = {
            "cells": notebook.cells,
            "receipts": notebook.receipts,
            "notes": notebook.notes,
        }
    except Unreadable as unreadable:
        reply = {"reason": str(unreadable)}
    json.dump(reply, sys.stdout)
