"""``autograder merge``: join gradebooks in which several people marked."""

from __future__ import annotations

import argparse
import sqlite3
from pathlib import Path

from rich.console import Console

from autograder.cli.exit_status import BROKEN, DONE
from autograder.cli.shared_arguments import (
    GRADEBOOK,
    Commands,
    add_class_list,
    add_out,
    gradebook_path,
    load,
    use_class_list,
)
from autograder.errors import UsageError


def add(commands: Commands) -> None:
    """Describe the command."""
    merge = commands.add_parser(
        "merge",
        help="join gradebooks: marks by hand, overrides, notes",
        description="Adds to the gradebook in --out whatever the others have and it lacks; if "
        "there is none yet, it starts as a copy of the first. Conflicts are shown and count for "
        "nobody until you decide them with `mark` or `override`; the exit status is 1 until then.",
    )
    merge.add_argument("books", nargs="+", type=Path, metavar="GRADEBOOK", help="a file or folder")
    add_out(merge)
    add_class_list(merge)
    merge.set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Merge one after the other, write the reports, and show what contradicts."""
    from autograder.gradebook import Gradebook
    from autograder.gradebook.merge import merge
    from autograder.reports.terminal import printable, warn
    from autograder.reports.write import Options, write_reports

    course = load(parsed)
    paths = [path / GRADEBOOK if path.is_dir() else path for path in parsed.books]
    for path in paths:
        if not path.exists():
            raise UsageError(f"There is no gradebook at {path}; name its folder or file.")
    target = gradebook_path(parsed)
    if not target.exists():
        _copy(paths[0], target)
    conflicts = 0
    with Gradebook(target, create=False) as into:
        for path in paths:
            if path.resolve() == target.resolve():
                continue
            with Gradebook(path, create=False) as other:
                done = merge(into, other)
            console.print(
                f"{path}: {done.decisions} marks and overrides, {done.notes} notes and "
                f"{done.students} students were added.",
                markup=False,
                soft_wrap=True,
            )
            for conflict in done.conflicts:
                warn(printable(conflict))
            conflicts += len(done.conflicts)
        class_list = use_class_list(parsed, into)
        write_reports(course, into, Options(parsed.out, None, class_list))
        waiting = sum(bool(record.disputes) for record in into.records())
    if waiting:
        console.print(f"{waiting} students have conflicting points; see `autograder mark`.")
    return BROKEN if conflicts or waiting else DONE


def _copy(source: Path, target: Path) -> None:
    """Copy a database that somebody may be writing to."""
    from autograder.gradebook import Gradebook

    Gradebook(source, create=False).close()  # says in one sentence what is wrong with it
    target.parent.mkdir(parents=True, exist_ok=True)
    before, copy = sqlite3.connect(source), sqlite3.connect(target)
    try:
        before.backup(copy)
    finally:
        before.close()
        copy.close()
