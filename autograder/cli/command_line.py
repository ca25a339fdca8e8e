"""Finds the command that is wanted, and turns errors into sentences.

A command's module has ``add(commands)``, which describes its arguments, and the function that it
sets as ``run``: it takes the parsed arguments and a console and returns the exit status.
"""

from __future__ import annotations

import argparse
import os
import platform
import sys
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console

from autograder import __version__
from autograder.cli import (
    adjust,
    build,
    check,
    collect,
    deal,
    doctor,
    export,
    feedback,
    grade,
    intake,
    mark,
    merge,
    mistakes,
    new,
    note,
    override,
    regrade,
    release,
    schema,
    show,
    similar,
    watch,
)
from autograder.cli.exit_status import BROKEN, DONE, INTERRUPTED, WRONG_USAGE
from autograder.cli.missing_extras import missing_extra
from autograder.errors import AutograderError, UsageError, machine_error
from autograder.reports.plain_text import make_plain

_COMMANDS = (
    *(collect, intake, grade, regrade, show, override, note),
    *(mark, merge, adjust, export, feedback, similar, mistakes, release),
    *(new, build, deal, check, watch, schema, doctor),
)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command and return the exit status.

    0: done, whatever the marks; 1: the course or the run is broken, or needs a person; 2: wrong
    usage; 130: interrupted.
    """
    make_plain(sys.stdout, sys.stderr)
    parsed = parser().parse_args(arguments)
    console = Console(highlight=False)
    try:
        _check_folder_to_write(parsed)
        return int(parsed.run(parsed, console))
    except UsageError as error:
        print(f"autograder: {error}", file=sys.stderr)
        return WRONG_USAGE
    except AutograderError as error:
        print(f"autograder: {error}", file=sys.stderr)
        return BROKEN
    except KeyboardInterrupt:
        print("autograder: stopped; run it again to go on.", file=sys.stderr)
        return INTERRUPTED
    except ModuleNotFoundError as error:
        told = missing_extra(error)
        if told is None:
            raise
        print(f"autograder: {told}", file=sys.stderr)
        return BROKEN
    except (OSError, MemoryError, RuntimeError) as error:
        if isinstance(error, BrokenPipeError):  # `autograder show ada | head`
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            return DONE
        short = machine_error(error)
        if short is None:
            raise
        print(f"autograder: {short}", file=sys.stderr)
        return BROKEN


def _check_folder_to_write(parsed: argparse.Namespace) -> None:
    out = str(getattr(parsed, "out", None) or "")
    if any("\ud800" <= sign <= "\udfff" for sign in out):
        shown = out.encode("utf-8", "replace").decode()
        raise UsageError(
            f"The name {shown} is not UTF-8, so no gradebook can be in it; name another."
        )


def parser() -> argparse.ArgumentParser:
    """The whole command line, for reading arguments and for the page that lists them."""
    whole = argparse.ArgumentParser(
        prog="autograder",
        description="Mark a course, see how the class did, and write the notebooks.",
        epilog="AUTOGRADER_COURSE names the course's folder where --course is not given. "
        "All environment variables are described in docs/engine.md.",
    )
    _add_course(whole, None)
    whole.add_argument(
        "--version",
        action="version",
        version=f"autograder {__version__} (Python {platform.python_version()})",
    )
    commands = whole.add_subparsers(required=True, metavar="COMMAND")
    for command in _COMMANDS:
        command.add(commands)
    for of_command in dict.fromkeys(commands.choices.values()):
        # Suppressed: a default here would undo what stands before the command.
        _add_course(of_command, argparse.SUPPRESS)
    return whole


def _add_course(parser: argparse.ArgumentParser, default: str | None) -> None:
    """The course's folder, before or after the command."""
    parser.add_argument(
        "--course",
        type=Path,
        default=default,
        metavar="DIR",
        help="the course's folder (default: found from here)",
    )
