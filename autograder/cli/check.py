"""``autograder check``: prove the course."""

from __future__ import annotations

import argparse

from rich.console import Console

from autograder.cli.common import Commands, load
from autograder.cli.status import BROKEN, DONE


def add(commands: Commands) -> None:
    """Describe the command."""
    commands.add_parser("check", help="prove the course").set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Print every problem; the status says whether there is one."""
    from autograder.authoring.proof import prove_course
    from autograder.authoring.proof_by_mutants import kept_promises

    course = load(parsed)
    with console.status("") as status:
        problems = prove_course(course.root, lambda step: status.update(f"proving: {step}"))
    for line in [] if problems else kept_promises(course):
        print(line)
    for problem in problems:
        print(problem)
    if problems:
        print(f"{len(problems)} problem{'s' if len(problems) > 1 else ''}.")
        return BROKEN
    print(f"The course is sound: {len(course.questions)} questions prove themselves.")
    return DONE
