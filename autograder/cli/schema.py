"""``autograder schema``: what editors need to complete and check questions and answers."""

from __future__ import annotations

import argparse

from rich.console import Console

from autograder.cli.exit_status import BROKEN, DONE
from autograder.cli.shared_arguments import Commands, load


def add(commands: Commands) -> None:
    """Describe the command."""
    schema = commands.add_parser("schema", help="write the schemas that editors complete TOML by")
    schema.add_argument(
        "--check", action="store_true", help="write nothing, and say whether they are up to date"
    )
    schema.set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Write the schemas, or compare them with those that stand."""
    from autograder.authoring.schema import schema_files

    root = load(parsed).root
    stale = []
    for name, text in schema_files():
        path = root / name
        if path.is_file() and path.read_text(encoding="utf-8") == text:
            continue
        stale.append(name)
        if not parsed.check:
            path.parent.mkdir(exist_ok=True)
            path.write_text(text, encoding="utf-8", newline="\n")
    if not parsed.check:
        print("Up to date." if not stale else f"Wrote {', '.join(stale)}.")
        return DONE
    if stale:
        print(f"Out of date: {', '.join(stale)}. Run autograder schema.")
    return BROKEN if stale else DONE
