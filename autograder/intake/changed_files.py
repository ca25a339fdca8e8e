"""Files that were changed since somebody looked: their sizes and times then and now."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from autograder.intake.long_list import LongList


def snapshot(paths: Sequence[Path]) -> dict[Path, tuple[int, int]]:
    """Size and time of every file at the paths, to see later whether anything was changed."""
    seen: dict[Path, tuple[int, int]] = {}
    for path in dict.fromkeys(paths):
        files = [path]
        if path.is_dir() and not path.is_symlink():
            files = [file for file in path.rglob("*") if file.is_file() and not file.is_symlink()]
        for file in files:
            try:
                status = file.lstat()
            except OSError:
                continue
            seen[file] = (status.st_size, status.st_mtime_ns)
    return seen


def snapshot_class(paths: Iterable[Path]) -> LongList[tuple[Path, tuple[int, int]]]:
    """As `snapshot`, for the places of a class of any size: each file with its size and time."""
    seen: LongList[tuple[Path, tuple[int, int]]] = LongList(tuple[Path, tuple[int, int]])
    last = None
    for path in paths:
        if path != last:  # what lies in one zip follows each other
            seen += snapshot([path]).items()
        last = path
    return seen


def changed_since(before: Iterable[tuple[Path, tuple[int, int]]]) -> list[Path]:
    """The files that are no longer as they were."""
    return [path for path, status in before if snapshot([path]).get(path) != status]
