"""``autograder doctor``: try each kind of isolation and say which works here."""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

from rich.console import Console

from autograder.cli.exit_status import BROKEN, DONE
from autograder.cli.shared_arguments import Commands, load
from autograder.course import Course, Settings
from autograder.errors import CourseError


def add(commands: Commands) -> None:
    """Describe the command."""
    doctor = commands.add_parser(
        "doctor", help="try each kind of isolation and say which works here"
    )
    doctor.set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Try each kind of isolation and say what held."""
    from autograder.sandbox.doctor import run_doctor

    with tempfile.TemporaryDirectory() as folder:
        findings = run_doctor(_course(parsed, Path(folder), console))
    for finding in findings:
        sign = "[green]✓[/green]" if finding.holds else "[red]✗[/red]"
        console.print(sign, end=" ")
        console.print(f"{finding.name}: {finding.text} {finding.advice}".rstrip(), markup=False)
    return DONE if findings[-1].holds else BROKEN


def _course(parsed: argparse.Namespace, folder: Path, console: Console) -> Course:
    """The course, or an empty one: isolation is a matter of the machine, not of a course."""
    try:
        return load(parsed)
    except CourseError as error:
        if parsed.course is not None:
            raise
        console.print(f"{error} Isolation is tried without a course.", markup=False, soft_wrap=True)
        (folder / "notebooks").mkdir()
        return Course(folder, (), Settings())
