"""Compiled modules and the list of fonts, kept so that no sandbox has to make them anew."""

from __future__ import annotations

import functools
import os
import subprocess
import sys
from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory

from autograder.sandbox.stale_bytecode import are_known, keep_imported, stale_modules

_PACKAGE = Path(__file__).parents[1]
_SECONDS = 120.0  # to import and compile everything


def font_folder() -> Path | None:
    """Where matplotlib keeps its list of fonts on this machine, if it has one."""
    cache = os.environ.get("XDG_CACHE_HOME") or "~/.cache"
    given = os.environ.get("MPLCONFIGDIR")
    folder = Path(given) if given else Path(cache).expanduser() / "matplotlib"
    return folder if any(folder.glob("fontlist-*.json")) else None


def compile_libraries() -> None:
    """Make Python keep compiled modules and matplotlib its fonts, if they are not of use yet.

    The sandbox writes nothing, so without this every run would compile sympy anew.
    """
    if font_folder() is not None and are_known() and next(stale_modules(), None) is None:
        return
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    environment["PYTHONPATH"] = str(_PACKAGE.parent)
    with suppress(subprocess.TimeoutExpired, OSError), TemporaryDirectory() as responses:
        environment["AUTOGRADER_RESPONSES"] = responses
        imported = Path(responses) / "imported.txt"
        subprocess.run(
            # This runs with the instructor's rights, so nothing may be imported from the current
            # folder, which may hold what students handed in.
            [sys.executable, "-P", "-m", "autograder.sandbox.inside.warm_imports", str(imported)],
            cwd="/",
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            timeout=_SECONDS,
            check=False,
        )
        lines = imported.read_text(encoding="utf-8", errors="surrogateescape").splitlines()
        keep_imported(map(Path, lines))


@functools.cache
def compile_libraries_once() -> None:
    """`compile_libraries`, but only for the first sandbox of a process: it looks at many files."""
    compile_libraries()
