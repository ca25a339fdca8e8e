"""Whether the libraries' compiled modules are of use: one that is older than its source is not.

An environment that was copied (by ``cp -r``, in the layers of a container, from a backup) has
sources with new times, and a library that was upgraded has no compiled modules. Python then makes
them anew at every start, and where it may not write, as in the sandbox, it does so for ever.
"""

from __future__ import annotations

import hashlib
import importlib.util
import os
import sys
from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path

# Modules that every sandbox imports; they stand for all others of their library until it is known
# which ones are imported.
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
    for path in _imported():
        if not is_compiled(path) and path.is_file() and _can_be_written(path.parent):
            yield path


def never_renewed() -> Path | None:
    """The folder of libraries that every start compiles anew, since it may not be written."""
    for folder, path in _samples():
        if path.is_file() and not is_compiled(path) and not _can_be_written(path.parent):
            return folder
    return None


def are_known() -> bool:
    """Whether it is known which modules a sandbox imports, or cannot be kept."""
    kept = _kept()
    return kept.is_file() or not os.access(_nearest(kept.parent), os.W_OK)


def keep_imported(paths: Iterable[Path]) -> None:
    """Keep which modules a sandbox imports, as far as they could be compiled."""
    kept = _kept()
    with suppress(OSError):
        kept.parent.mkdir(parents=True, exist_ok=True)
        unfinished = kept.with_suffix(f".{os.getpid()}")
        lines = "".join(f"{path}\n" for path in paths if is_compiled(path))
        unfinished.write_text(lines, encoding="utf-8", errors="surrogateescape", newline="\n")
        os.replace(unfinished, kept)


def _kept() -> Path:
    """The file with the modules of this environment, among what the user can make anew."""
    cache = Path(os.environ.get("XDG_CACHE_HOME") or "~/.cache").expanduser()
    environment = f"{sys.prefix}\0{sys.version}\0{__file__}".encode(errors="surrogateescape")
    return cache / "autograder" / f"imported-{hashlib.sha256(environment).hexdigest()[:16]}.txt"


def _nearest(folder: Path) -> Path:
    """The folder itself, or the one above it that is there."""
    return next(above for above in (folder, *folder.parents) if above.is_dir())


def _imported() -> Iterator[Path]:
    with suppress(OSError):
        lines = _kept().read_text(encoding="utf-8", errors="surrogateescape").splitlines()
        yield from map(Path, lines)
        return
    yield from (path for _, path in _samples())


def _samples() -> Iterator[tuple[Path, Path]]:
    """Some modules of the libraries, each with the folder in which its library is installed."""
    for name, modules in _LOOKED_AT.items():
        found = importlib.util.find_spec(name)
        if found is None or found.origin is None:
            continue
        library = Path(found.origin).parent
        yield from ((library.parent, library / module) for module in modules)


def is_compiled(source: Path) -> bool:
    """Whether Python will take the compiled form of a module as it is."""
    try:
        compiled = os.open(importlib.util.cache_from_source(str(source)), os.O_RDONLY)
        try:
            header = os.read(compiled, _HEADER)
        finally:
            os.close(compiled)
        of_source = os.stat(source)
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
