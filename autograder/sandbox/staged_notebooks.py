"""What the working folder in a sandbox shows: no notebooks, and nobody's responses."""

from __future__ import annotations

import shutil
from pathlib import Path


def stage(root: Path, folder: Path) -> None:
    """Copy what a notebook's working folder shows.

    That is the course's notebooks folder without the notebooks themselves and without anybody's
    responses.
    """
    source = root / "notebooks"
    target = folder / "notebooks"
    if not source.is_dir():
        target.mkdir()
        return
    ignored = shutil.ignore_patterns("responses", "*.ipynb", "*.zip", "__pycache__", ".*")
    shutil.copytree(source, target, ignore=ignored)
    for path in (target, *target.rglob("*")):
        path.chmod(0o755 if path.is_dir() else 0o644)
