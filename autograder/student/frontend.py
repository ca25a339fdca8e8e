"""The front end: whether somebody is there to click, and what it tells about cells and notebooks.

Widgets are shown only where they can be drawn. Everywhere else (a terminal, nbval, nbclient, the
grader) the same calls give plain text and Markdown, which are the same in every run and load
nothing slow.
"""

from __future__ import annotations

import os
import sys
from typing import Any

SWITCH = "AUTOGRADER_WIDGETS"
VSCODE_FILE = "__vsc_ipynb_file__"  # the variable that Visual Studio Code sets in its kernels


def widgets_wanted() -> bool:
    """Whether to show widgets.

    The environment variable ``AUTOGRADER_WIDGETS`` decides outright (``1`` or ``0``). Without it,
    they are shown in a kernel that a Jupyter server has started for a notebook on the screen, as
    JupyterLab and Notebook 7 do, or that Visual Studio Code has started.
    """
    setting = os.environ.get(SWITCH)
    if setting in ("0", "1"):
        return setting == "1"
    shell = running_shell()
    if shell is None or not hasattr(shell, "kernel"):
        return False
    return "JPY_SESSION_NAME" in os.environ or in_vscode()


def in_vscode() -> bool:
    """Whether Visual Studio Code shows the notebook.

    It draws widgets only where it can load their code, and shows an error in their place otherwise.
    """
    shell = running_shell()
    return shell is not None and VSCODE_FILE in getattr(shell, "user_ns", ())


def running_shell() -> Any:
    """The IPython shell that runs this code, or None. IPython is not imported for it."""
    ipython = sys.modules.get("IPython")
    return ipython.get_ipython() if ipython is not None else None


def current_cell() -> str | None:
    """The id of the cell that is being run, where the front end tells it."""
    metadata = _metadata()
    colab = metadata.get("colab")
    cell = metadata.get("cellId") or (colab.get("cell_id") if isinstance(colab, dict) else None)
    return str(cell) if cell else None


def deleted_cells() -> list[str]:
    """The ids of cells that were deleted since the last run, where the front end tells them."""
    deleted = _metadata().get("deletedCells")
    return [str(cell) for cell in deleted] if isinstance(deleted, list) else []


def colab_notebook() -> dict[str, Any] | None:
    """The notebook on the screen, from Google Colab; None anywhere else, or if it does not answer.

    Colab keeps a notebook in the student's Drive, where no kernel sees it, but hands it out as it
    is now, saved or not.
    """
    if not in_colab():
        return None
    try:
        from google.colab import _message  # type: ignore[import-not-found]

        reply = _message.blocking_request("get_ipynb", request="", timeout_sec=30)
    except Exception:  # whatever goes wrong there, the student is told to save a copy
        return None
    notebook = reply.get("ipynb") if isinstance(reply, dict) else None
    return notebook if isinstance(notebook, dict) else None


def in_colab() -> bool:
    """Whether the kernel is one of Google Colab's, which have its package loaded from the start."""
    return "google.colab" in sys.modules


def _metadata() -> dict[str, Any]:
    """What the front end sent along with the code that is being run."""
    shell = running_shell()
    if shell is None or not hasattr(shell, "get_parent"):
        return {}
    return shell.get_parent().get("metadata") or {}
