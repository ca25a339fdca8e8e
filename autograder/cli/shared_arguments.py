"""What several commands share: arguments, the course, and output for machines."""

from __future__ import annotations

import argparse
import getpass
import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from autograder.course import Course, load_course
from autograder.errors import UsageError

if TYPE_CHECKING:
    from autograder.gradebook import Gradebook
    from autograder.grading.dask_address import ClusterAddress
    from autograder.intake.class_list import ClassList

Commands = Any  # argparse has no public name for what add_subparsers returns
GRADEBOOK = "gradebook.db"


def load(parsed: argparse.Namespace) -> Course:
    """The course that the arguments name."""
    return load_course(parsed.course)


def gradebook_path(parsed: argparse.Namespace) -> Path:
    """The gradebook in the folder that ``--out`` names."""
    path: Path = parsed.out / GRADEBOOK
    return path


def add_out(command: argparse.ArgumentParser) -> None:
    """The folder of the gradebook and the reports."""
    command.add_argument(
        "--out",
        type=Path,
        default=Path("grades"),
        metavar="DIR",
        help="the folder of the gradebook and the reports (default: grades)",
    )


def add_json(command: argparse.ArgumentParser) -> None:
    """Output for machines."""
    command.add_argument("--json", action="store_true", help="print JSON")


def add_grading(command: argparse.ArgumentParser) -> None:
    """What `grade` and `regrade` have in common."""
    add_out(command)
    command.add_argument(
        "--jobs",
        type=_positive,
        default=os.cpu_count() or 1,
        metavar="N",
        help="how many submissions to grade at once",
    )
    command.add_argument(
        "--cluster",
        type=_cluster,
        metavar="ADDRESS",
        help="grade on a Dask cluster: a scheduler such as tcp://lab-1:8786, or local:N workers",
    )
    command.add_argument(
        "--question", action="append", metavar="ID", help="mark only this question (repeatable)"
    )
    command.add_argument(
        "--seed", type=int, metavar="N", help="of the hidden inputs (default: the last run's)"
    )
    command.add_argument(
        "--no-sandbox",
        action="store_true",
        help="no isolation: what students wrote can read, change and send away all that you can; "
        "only for work that you trust; every report says so",
    )
    command.add_argument(
        "--dry-run", action="store_true", help="show what would change, and write nothing"
    )
    command.add_argument(
        "--explanations",
        action=argparse.BooleanOptionalAction,
        help="whether students' feedback explains the answers "
        "(default: as in the last run, at first no)",
    )
    add_class_list(command)
    add_times(command)
    add_json(command)


def add_author(command: argparse.ArgumentParser) -> None:
    """Who decides: kept beside the decision, so that two can share the work."""
    command.add_argument(
        "--author",
        default=os.environ.get("AUTOGRADER_AUTHOR") or _user(),
        metavar="NAME",
        help="who decides this (default: AUTOGRADER_AUTHOR, or your login here)",
    )


def add_class_list(command: argparse.ArgumentParser) -> None:
    """Who is in the class."""
    command.add_argument(
        "--class-list",
        action="append",
        type=Path,
        metavar="FILE",
        help="a class list as Canvas, Moodle, Gradescope or GitHub Classroom exports it, or TOML "
        "with the late policy (repeatable; default: those last given to a "
        "command that changes something, or class.toml in --out)",
    )


def add_layout(command: argparse.ArgumentParser) -> None:
    """How a download is read."""
    from autograder.intake.find_submissions import LAYOUT_NAMES

    command.add_argument(
        "--layout",
        choices=LAYOUT_NAMES,
        metavar="NAME",
        help=f"how the download is laid out: {', '.join(LAYOUT_NAMES)} (default: by its marks)",
    )


def add_times(command: argparse.ArgumentParser) -> None:
    """Where times come from, and whether anything that needs a person is an error."""
    command.add_argument(
        "--times",
        type=Path,
        metavar="FILE",
        help="a table of students and times (default: times.csv beside the submissions)",
    )
    command.add_argument(
        "--trust-times",
        action=argparse.BooleanOptionalAction,
        help="take the times as they are, those of the files too where nothing else says when "
        "(default: as in the last run, at first no)",
    )
    command.add_argument("--strict", action="store_true", help="exit 1 if something needs a person")


def find_class_list(parsed: argparse.Namespace, book: Gradebook | None) -> ClassList:
    """The class lists that are given, were given before, or lie beside the gradebook.

    ``students.toml`` in ``--out`` or beside a class list says whose a submission is. Without a
    list, an empty one: nobody is late, and nobody has a number.
    """
    from autograder.intake.class_list import read_class_lists

    given: list[Path] = list(parsed.class_list or ())
    if not given and book is not None:
        before = book.setting("class_list") or "[]"
        given = [Path(path) for path in (json.loads(before) if before[:1] == "[" else [before])]
    beside: Path = parsed.out / "class.toml"
    if beside.exists() and not any(path.suffix.lower() == ".toml" for path in given):
        given.append(beside)
    places = [parsed.out, *(path.parent for path in given)]
    settled = next((p / "students.toml" for p in places if (p / "students.toml").exists()), None)
    return read_class_lists(given, settled)


def use_class_list(parsed: argparse.Namespace, book: Gradebook) -> ClassList:
    """As `find_class_list`; lists that are given are those of later commands too.

    For commands that change something: one that only shows leaves the gradebook as it is.
    """
    class_list = find_class_list(parsed, book)
    if parsed.class_list and not getattr(parsed, "dry_run", False):
        book.set("class_list", json.dumps([str(path.resolve()) for path in parsed.class_list]))
    return class_list


def print_json(value: object) -> None:
    """Write JSON to standard output; other characters than ASCII are escaped."""
    print(json.dumps(value, indent=1))


def _user() -> str:
    try:
        return getpass.getuser()
    except (OSError, KeyError, ImportError):  # no such user in the system, as in a container
        return ""


def _cluster(text: str) -> ClusterAddress:
    from autograder.grading.dask_address import parse_address

    try:
        return parse_address(text)
    except UsageError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def _positive(text: str) -> int:
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError("give a number of at least 1")
    return number
