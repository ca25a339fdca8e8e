"""``autograder release``: write the student bundle."""

from __future__ import annotations

import argparse
from pathlib import Path

from rich.console import Console

from autograder.cli.exit_status import DONE
from autograder.cli.shared_arguments import Commands, load


def add(commands: Commands) -> None:
    """Describe the command."""
    release = commands.add_parser("release", help="write the student bundle, without any answer")
    release.add_argument("folder", type=Path, metavar="DIR", help="a new folder")
    release.add_argument(
        "--practice",
        action="append",
        nargs="?",
        const="",
        metavar="CHAPTER",
        help="put the key of this chapter into the bundle (repeatable; alone: of all chapters)",
    )
    release.set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Write the bundle and say what it holds."""
    from autograder.release.bundle import release
    from autograder.release.large_files import large_files

    course = load(parsed)
    practice = list(dict.fromkeys(parsed.practice or []))
    if "" in practice:
        practice = [chapter.name for chapter in course.chapters]
    with console.status("") as status:
        bundle = release(course, parsed.folder, practice, lambda step: status.update(step))
    notebooks = sum(path.suffix == ".ipynb" for path in bundle.files)
    size = sum((bundle.folder / path).stat().st_size for path in bundle.files) / 1e6
    console.print(
        f"{bundle.folder} holds {notebooks} {'notebook' if notebooks == 1 else 'notebooks'}, "
        f"{len(bundle.files)} files, {size:.1f} MB; "
        "no answer was found in it.",
        markup=False,
        soft_wrap=True,
    )
    for stays in bundle.left_out:
        console.print(f"Left out: {stays.path}; {stays.reason}.", markup=False, soft_wrap=True)
    for sentence in large_files(bundle):
        console.print(sentence, markup=False, soft_wrap=True)
    for missed in bundle.blind:
        console.print(
            f"Its checks cannot tell this mistake: {missed}", markup=False, soft_wrap=True
        )
    return DONE
