"""``autograder doctor``: say which isolation works here, by trying it."""

from __future__ import annotations

import argparse

from rich.console import Console

from autograder.cli.common import Commands, load
from autograder.cli.status import BROKEN, DONE


def add(commands: Commands) -> None:
    """Describe the command."""
    doctor = commands.add_parser("doctor", help="say which isolation works here, by trying it")
    doctor.set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Try each kind of isolation and say what held."""
    from autograder.sandbox.doctor import run_doctor

    findings = run_doctor(load(parsed))
    for finding in findings:
        sign = "[green]✓[/green]" if finding.holds else "[red]✗[/red]"
        console.print(sign, end=" ")
        console.print(f"{finding.name}: {finding.text} {finding.advice}".rstrip(), markup=False)
    return DONE if findings[-1].holds else BROKEN
