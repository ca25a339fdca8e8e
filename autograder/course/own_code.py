"""A course's packages are its own: ``import data`` finds those of the course that is asked for.

Every course has packages ``data`` and ``solutions``, so none is installed, and one process may meet
two courses (a notebook that changes folder, a check of several): the course's folder goes to the
head of the import path, and what another course loaded under the same names is forgotten.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable
from pathlib import Path

OWN = ("data", "notebooks", "solutions")


def put_first(root: Path, names: Iterable[str] = OWN) -> None:
    """Make ``import name`` find the packages in ``root`` from here on, for each of the names."""
    root = root.resolve()
    here = str(root)
    if sys.path[:1] != [here]:
        sys.path[:] = [here, *(entry for entry in sys.path if entry != here)]
    for name in names:
        if _is_of_another_course(name, root):
            _forget(name)


def _is_of_another_course(name: str, root: Path) -> bool:
    """Whether a package is loaded from elsewhere though the course has one of its name."""
    loaded = sys.modules.get(name)
    if loaded is None or not ((root / name).is_dir() or (root / f"{name}.py").is_file()):
        return False
    file = getattr(loaded, "__file__", None)
    places = [file] if file else [*getattr(loaded, "__path__", [])]  # none: without __init__.py
    # Its own, not merely below it: a course may stand in the folder of another.
    own = ((root / name).resolve(), (root / f"{name}.py").resolve())
    return not any(Path(place).resolve().is_relative_to(mine) for place in places for mine in own)


def _forget(name: str) -> None:
    for loaded in [*sys.modules]:
        if loaded == name or loaded.startswith(f"{name}."):
            del sys.modules[loaded]
