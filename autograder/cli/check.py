"""``autograder check``: prove the course."""

from __future__ import annotations

import argparse

from rich.console import Console

from autograder.cli.exit_status import BROKEN, DONE
from autograder.cli.shared_arguments import Commands, load


def add(commands: Commands) -> None:
    """Describe the command."""
    command = commands.add_parser("check", help="prove the course")
    command.add_argument(
        "--without-mutants", action="store_true", help="leave the mutants out, which take longest"
    )
    command.set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Print every problem; the status says whether there is one."""
    from autograder.authoring.build import stale_notebooks
    from autograder.authoring.proof import prove_course
    from autograder.authoring.proof_by_mutants import kept_promises, tried_styles

    course = load(parsed)
    with console.status("") as status:

        def report(step: str) -> None:
            status.update(f"proving: {step}")

        problems = prove_course(course.root, report, mutants=not parsed.without_mutants)
    if problems:
        for problem in problems:
            print(problem)
        print(f"{len(problems)} problem{'s' if len(problems) > 1 else ''}.")
        return BROKEN
    for line in (*kept_promises(course), *tried_styles(course)):
        print(line)
    for path in stale_notebooks(course):
        print(f"{path.relative_to(course.root)} is not what the masters give: autograder build.")
    print(f"The course is sound: {len(course.questions)} questions prove themselves.")
    return DONE
