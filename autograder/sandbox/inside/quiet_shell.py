"""An IPython shell as Jupyter has it that shows nobody anything, and draws no figure."""

from __future__ import annotations

import base64
import sys
from contextlib import suppress
from pathlib import Path
from typing import Any

_PIXEL = base64.b64decode(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJg"
    "gg=="
)


def save_nothing(figure: object, target: Any, *arguments: object, **options: object) -> None:
    """Stand in for ``Figure.savefig``: a picture of one pixel."""
    if hasattr(target, "write"):
        target.write(_PIXEL)
    else:
        Path(target).write_bytes(_PIXEL)


def close_figures() -> None:
    """Forget the figures of a cell, as Jupyter does after it has shown them."""
    helpers = sys.modules.get("matplotlib._pylab_helpers")
    if helpers is not None:
        with suppress(Exception):
            helpers.Gcf.destroy_all()


def quiet_shell() -> Any:
    """IPython as Jupyter's kernel has it, magics and all, without output, history or programs."""
    from IPython.core.displayhook import DisplayHook
    from IPython.core.displaypub import DisplayPublisher
    from IPython.core.interactiveshell import InteractiveShell
    from IPython.core.magics.script import ScriptMagics
    from IPython.utils.text import SList
    from traitlets.config import Config

    class NoResults(DisplayHook):
        def __call__(self, result: object = None) -> None:
            """Drop the value of a cell's last line."""

    class NoOutputs(DisplayPublisher):
        def publish(self, *args: object, **kwargs: object) -> None:
            """Drop what display() shows."""

    class QuietShell(InteractiveShell):
        def showtraceback(self, *args: object, **kwargs: object) -> None:
            """Formatting a traceback costs more than most cells."""

        showsyntaxerror = showtraceback
        showindentationerror = showtraceback

        def system(self, cmd: str) -> None:
            """``!command`` and ``%pip`` do nothing here, and the cell goes on."""
            self.user_ns["_exit_code"] = 127

        system_piped = system_raw = system

        def getoutput(self, cmd: str, split: bool = True, depth: int = 0) -> object:
            """``x = !command`` gives nothing."""
            return SList() if split else ""

        def enable_gui(self, gui: object = None) -> None:
            """There is no window to show."""

        def enable_matplotlib(self, gui: object = None) -> tuple[str, str]:
            """``%matplotlib inline`` would draw every figure."""
            return "inline", "agg"

    def show_nothing(response: object, *arguments: object, **options: object) -> object:
        """Do not even ask an object how it would be shown."""
        return {}, {}

    config = Config()
    config.HistoryManager.enabled = False
    shell = QuietShell.instance(
        config=config, displayhook_class=NoResults, display_pub_class=NoOutputs
    )

    shell.display_formatter.format = show_nothing

    def do_nothing(self: object, line: str = "", cell: str = "") -> None:
        """``%%bash`` and its like do nothing here."""

    ScriptMagics.shebang = do_nothing
    shell.register_magic_function(lambda line, cell: None, "cell", "script")
    return shell
