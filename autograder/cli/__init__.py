"""The command line: one command a file, which `command_line` finds and runs."""

from autograder.cli.command_line import main, parser
from autograder.cli.exit_status import BROKEN, DONE, INTERRUPTED, WRONG_USAGE

__all__ = ["BROKEN", "DONE", "INTERRUPTED", "WRONG_USAGE", "main", "parser"]
