"""``autograder deal``: neighbours in the class list get other numbers."""

from __future__ import annotations

import argparse
from pathlib import Path

from rich.console import Console

from autograder.cli.exit_status import DONE
from autograder.cli.shared_arguments import Commands, load
from autograder.errors import UsageError


def add(commands: Commands) -> None:
    """Describe the command."""
    deal = commands.add_parser(
        "deal",
        help="give neighbours in the class list other numbers, before the course is released",
    )
    deal.add_argument(
        "class_list",
        nargs="+",
        type=Path,
        metavar="CLASS_LIST",
        help="as Canvas, Moodle, Gradescope or GitHub Classroom exports it, in its order",
    )
    deal.add_argument(
        "--again",
        action="store_true",
        help="deal anew, which may change the numbers of everybody",
    )
    deal.set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Write places.toml, and say whose numbers are left to chance."""
    from autograder.course.places import FILE, make_places
    from autograder.intake.class_list import read_class_lists
    from autograder.intake.class_list_places import seats
    from autograder.reports.terminal import printable, warn

    course = load(parsed)
    if not course.personal:
        raise UsageError(
            "Everybody has the numbers of the sheet in this course; write "
            'variants = "student" under [tool.autograder] in pyproject.toml first.'
        )
    path = course.root / FILE
    if path.exists() and not parsed.again:
        raise UsageError(
            f"{path} is there. Whoever came later has numbers too, by chance; "
            "--again deals anew, which may change the numbers of everybody."
        )
    people = read_class_lists(parsed.class_list, None).students
    wanted, shared = seats(people)
    path.write_text(make_places(wanted).text(), encoding="utf-8", newline="\n")
    for name in shared:
        warn(
            f"{printable(name)} is the name of more than one: whoever gives it has numbers by "
            "chance; let these give their login or number"
        )
    console.print(
        f"{len(people)} people have places, and neighbours other numbers; {path} is written and "
        "names nobody. Now: autograder build, then autograder release; whoever has an earlier "
        "bundle has other numbers in it.",
        markup=False,
        soft_wrap=True,
    )
    return DONE
