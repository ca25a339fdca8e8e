"""``autograder watch``: each save is followed by what it changes, and by what is wrong with it.

The work is done in a process of its own, anew for each save: references and mistakes are modules of
the course, which Python would not load a second time.
"""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

_WATCHED = {
    "notebooks": frozenset({".py", ".toml", ".js", ".css"}),
    "solutions": frozenset({".py", ".toml"}),
    "data": None,  # of any ending
}
_POLL_SECONDS = 0.3


def watch(root: Path, say: Callable[[str], None], once: bool = False) -> None:
    """Build and check the course at ``root`` now and after each save, until interrupted."""
    before: dict[Path, int] = {}
    while True:
        now = saved(root)
        if now != before:
            for line in changes(root, before, now):
                say(line)
            before = now
            for line in build_and_check(root):
                say(line)
        if once:
            return
        time.sleep(_POLL_SECONDS)


def saved(root: Path) -> dict[Path, int]:
    """When each file that matters was last written, in ns."""
    found = {}
    for folder, suffixes in _WATCHED.items():
        for path in (root / folder).rglob("*"):
            inside = path.relative_to(root).parts
            if "__pycache__" in inside or "responses" in inside or path.suffix == ".ipynb":
                continue
            if (suffixes is None or path.suffix in suffixes) and path.is_file():
                try:
                    found[path] = path.stat().st_mtime_ns
                except OSError:  # an editor has just replaced it: the next look sees the new one
                    continue
    return found


def changes(root: Path, before: dict[Path, int], now: dict[Path, int]) -> list[str]:
    """A line for each file that was saved or removed since; none at the first look."""
    if not before:
        return []
    touched = sorted(
        path for path in before.keys() | now.keys() if before.get(path) != now.get(path)
    )
    return [
        f"{path.relative_to(root)} was {'saved' if path in now else 'removed'}." for path in touched
    ]


def build_and_check(root: Path) -> Iterator[str]:
    """What `build` and `check` say, each line as it comes; errors stop after the first command."""
    for command in ("build", "check"):
        done = subprocess.run(
            [sys.executable, "-m", "autograder", "--course", str(root), command],
            capture_output=True,
            text=True,
            check=False,
        )
        yield from (done.stdout + done.stderr).splitlines()
        if done.returncode:
            return
