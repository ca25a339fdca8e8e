"""Whether somebody is there to click: widgets are shown only where they can be drawn.

Everywhere else (a terminal, nbval, nbclient, the grader) the same calls give plain text and
Markdown, which are the same in every run and load nothing slow.
"""

from __future__ import annotations

import os
import sys
from typing import Any

SWITCH = "AUTOGRADER_WIDGETS"


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
    return "JPY_SESSION_NAME" in os.environ or "__vsc_ipynb_file__" in shell.user_ns


def running_shell() -> Any:
    """The IPython shell that runs this code, or None. IPython is not imported for it."""
    ipython = sys.modules.get("IPython")
    return ipython.get_ipython() if ipython is not None else None


def current_cell() -> str | None:
    """The id of the cell that is being run, where the front end tells it."""
    shell = running_shell()
    if shell is None or not hasattr(shell, "get_parent"):
        return None
    metadata = shell.get_parent().get("metadata") or {}
    cell = metadata.get("cellId")
    return str(cell) if cell else None
