"""``autograder watch``: build and prove what is saved, as it is saved."""

from __future__ import annotations

import argparse

from rich.console import Console

from autograder.cli.exit_status import DONE
from autograder.cli.shared_arguments import Commands, load


def add(commands: Commands) -> None:
    """Describe the command."""
    watch = commands.add_parser("watch", help="build and check whenever a file is saved")
    watch.add_argument(
        "--once", action="store_true", help="do what is due now, and stop instead of waiting"
    )
    watch.set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Report on each save until Ctrl-C."""
    from autograder.authoring.watch import watch

    root = load(parsed).root
    print(f"Watching {root}. Stop with Ctrl-C.")
    try:
        watch(root, print, once=parsed.once)
    except KeyboardInterrupt:  # as it says above
        print("Stopped.")
    return DONE
