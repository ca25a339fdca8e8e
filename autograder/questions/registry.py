"""Finds the kinds of question: the folders of `autograder.kinds`, installed and registered ones.

A distribution adds a kind by an entry point of the group ``autograder.kinds``, whose name is the
kind's and whose value the package: ``matching = "my_package.matching"``. A course adds one by the
dotted name of a package in ``[tool.autograder] kinds``. Either package holds what a folder here
holds: ``kind.py`` with the object ``KIND``.
"""

from __future__ import annotations

import importlib
import pkgutil
import sys
from functools import lru_cache
from importlib.metadata import entry_points
from pathlib import Path
from typing import Any

from autograder.errors import CourseError
from autograder.questions.kind_protocol import Kind
from autograder.questions.question import Question

GROUP = FOLDERS = "autograder.kinds"  # of entry points, and the package of those found here
AnyKind = Kind[Any, Any]  # of a question and an answer of its own

_registered: dict[str, AnyKind] = {}


def kind_names() -> list[str]:
    """What authors may write as ``kind``, as far as it is found here or registered."""
    return sorted({*_folders(), *_installed(), *_registered})


def has_kind(name: str) -> bool:
    """Whether there is a kind of this name."""
    return name in _registered or name in _folders() or name in _installed()


def kind_named(name: str) -> AnyKind:
    """The kind of this name.

    Raises:
        CourseError: if there is none, or its package cannot be loaded.
    """
    if name not in _registered:
        package = _folders().get(name) or _installed().get(name)
        if package is None:
            raise CourseError(f"There is no kind {name!r}; there are {', '.join(kind_names())}.")
        load_kind(package)
    return _registered[name]


def kind_of(question: Question) -> AnyKind:
    """The kind of a question."""
    return kind_named(question.kind)


def register(kind: AnyKind) -> None:
    """Add a kind, in place of another one of its name."""
    _registered[kind.name] = kind


def load_kind(package: str, root: Path | None = None) -> None:
    """Register the kind in a package, which may be one of the course at ``root``.

    Raises:
        CourseError: if it holds none.
    """
    if root is not None and str(root) not in sys.path:
        sys.path.insert(0, str(root))
    try:
        register(importlib.import_module(f"{package}.kind").KIND)
    except (ImportError, AttributeError) as error:
        raise CourseError(f"{package} holds no kind of question: {error}.") from error


@lru_cache(maxsize=1)
def _folders() -> dict[str, str]:
    """The packages that come with the engine, by the kinds' names."""
    folder = importlib.import_module(FOLDERS).__path__
    return {
        entry.name: f"{FOLDERS}.{entry.name}"
        for entry in pkgutil.iter_modules(folder)
        if entry.ispkg
    }


@lru_cache(maxsize=1)
def _installed() -> dict[str, str]:
    """The packages of other distributions; looking for them takes longer."""
    return {point.name: point.value for point in entry_points(group=GROUP)}
