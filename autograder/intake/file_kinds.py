"""What a name says a file is: a notebook, saved responses, or an operating system's own."""

from __future__ import annotations

import re
from pathlib import PurePosixPath

# What operating systems and editors leave behind; nobody hands these in.
_SYSTEM = {"__macosx", "thumbs.db", "desktop.ini", ".ds_store", ".ipynb_checkpoints", "__pycache__"}
# 3_ransac.ipynb.json, and a second download of it: 3_ransac.ipynb (1).json.
_NOTEBOOK = re.compile(r"\.ipynb\s?(\(\d{1,9}\))?(\.json|\.txt)?\s?(\(\d{1,9}\))?\Z", re.IGNORECASE)
_SYSTEM_STARTS = ("._", "~$")


def is_notebook_name(name: str) -> bool:
    """Whether it is called a notebook, perhaps with what browsers add to the name."""
    return _NOTEBOOK.search(name[-80:]) is not None


def is_system(name: str) -> bool:
    """Whether an operating system or an editor made it."""
    return name.lower() in _SYSTEM or name.startswith(_SYSTEM_STARTS)


def is_wanted(path: PurePosixPath) -> bool:
    """Whether the file is a notebook or a chapter's saved responses."""
    if any(part.startswith((".", "__")) for part in path.parts):
        return False  # .ipynb_checkpoints, __MACOSX
    if is_notebook_name(path.name):
        return True
    return path.suffix == ".json" and path.parent.name == "responses"
