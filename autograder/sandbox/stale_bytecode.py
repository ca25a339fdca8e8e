"""Whether the libraries' compiled modules are of use: one that is older than its source is not.

An environment that was copied (by ``cp -r``, in the layers of a container, from a backup) has
sources with new times. Python then compiles every module anew at every start, and where it may not
write, as in the sandbox, it does so for ever.
"""

from __future__ import annotations

import importlib.util
import os
from collections.abc import Iterator
from pathlib import Path

# Modules that every sandbox imports; they stand for all others of their library.
_LOOKED_AT = {
    "sympy": ("__init__.py", "core/expr.py", "printing/str.py"),
    "numpy": ("__init__.py", "linalg/_linalg.py"),
    "matplotlib": ("__init__.py", "figure.py"),
    "IPython": ("__init__.py", "core/interactiveshell.py"),
}
_HEADER = 16  # bytes: the magic number, flags, and the source's time and size
_BY_HASH = 1


def stale_modules() -> Iterator[Path]:
    """Yield the modules of the libraries whose compiled form is missing or out of date here.

    One that cannot be written is left out: nothing would be gained by compiling it again.
    """
    for name, modules in _LOOKED_AT.items():
        found = importlib.util.find_spec(name)
        if found is None or found.origin is None:
            continue
        for module in modules:
            path = Path(found.origin).parent / module
            if path.is_file() and not is_compiled(path) and _can_be_written(path.parent):
                yield path


def is_compiled(source: Path) -> bool:
    """Whether Python will take the compiled form of a module as it is."""
    try:
        with open(importlib.util.cache_from_source(str(source)), "rb") as compiled:
            header = compiled.read(_HEADER)
        of_source = source.stat()
    except OSError:
        return False
    if len(header) < _HEADER or header[:4] != importlib.util.MAGIC_NUMBER:
        return False
    flags, time, size = (int.from_bytes(header[at : at + 4], "little") for at in (4, 8, 12))
    if flags & _BY_HASH:  # times do not count for these
        return True
    return (time, size) == (int(of_source.st_mtime) & 0xFFFFFFFF, of_source.st_size & 0xFFFFFFFF)


def _can_be_written(folder: Path) -> bool:
    cache = folder / "__pycache__"
    return os.access(cache if cache.is_dir() else folder, os.W_OK)
