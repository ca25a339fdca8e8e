"""``autograder build``: write the notebooks from the masters."""

from __future__ import annotations

import argparse

from rich.console import Console

from autograder.cli.exit_status import BROKEN, DONE
from autograder.cli.shared_arguments import Commands, load


def add(commands: Commands) -> None:
    """Describe the command."""
    build = commands.add_parser("build", help="write the notebooks from the masters")
    build.add_argument(
        "--check", action="store_true", help="write nothing; exit 1 if what is committed differs"
    )
    build.set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Write what differs, or say what does."""
    from autograder.authoring import build

    course = load(parsed)
    if parsed.check:
        stale = build.stale_notebooks(course)
        for path in stale:
            print(f"{path.relative_to(course.root)} differs from what the masters give.")
        if stale:
            print("Run `autograder build` and commit what it writes.")
        return BROKEN if stale else DONE
    with console.status("") as status:
        written = build.write(build.build_student_notebooks(course))
        written += build.write(
            build.build_solved_notebooks(course, lambda name: status.update(f"running {name}"))
        )
    for path in written:
        print(f"wrote {path.relative_to(course.root)}")
    if not written:
        print("Every notebook is up to date.")
    return DONE
