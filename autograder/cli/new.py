"""``autograder new``: begin a course."""

from __future__ import annotations

import argparse
import shlex
from pathlib import Path

from rich.console import Console

from autograder.cli.exit_status import DONE
from autograder.cli.shared_arguments import Commands
from autograder.course import load_course
from autograder.errors import CourseError


def add(commands: Commands) -> None:
    """Describe the command."""
    new = commands.add_parser("new", help="start a course: a small complete one to change")
    new.add_argument("folder", type=Path, metavar="DIR", help="a new folder")
    new.add_argument("--title", default="The pendulum", help="the title of the course")
    new.add_argument(
        "--from",
        type=Path,
        dest="layout",
        metavar="COURSE",
        help="copy the chapters, requirements and limits of this course, but no questions",
    )
    new.set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Write the course, build its notebooks, and say what to do next."""
    from autograder.authoring.build import build_solved_notebooks, build_student_notebooks, write
    from autograder.authoring.new_course import new_course

    layout = load_course(parsed.layout) if parsed.layout is not None else None
    files = new_course(parsed.folder, parsed.title, layout)
    course = load_course(parsed.folder)
    print(
        f"{parsed.folder} is a course of {len(files)} files and {len(course.questions)} questions."
    )
    first = ""
    with console.status("building the notebooks"):
        write(build_student_notebooks(course))
        try:
            write(build_solved_notebooks(course))
        except CourseError as error:  # such as a requirement of the course that is not here yet
            print(f"Its solved notebooks are not written yet: {error}")
            first = 'pip install -e ".[author,lab]" && autograder build && '
    there = shlex.quote(str(parsed.folder))
    print(f"Next: cd {there} && {first}autograder check; its README.md says the rest.")
    return DONE
