"""``autograder export``: grades for the systems that instructors use."""

from __future__ import annotations

import argparse
from pathlib import Path

from rich.console import Console

from autograder.cli.exit_status import DONE
from autograder.cli.shared_arguments import (
    Commands,
    add_class_list,
    add_out,
    gradebook_path,
    load,
    use_class_list,
)
from autograder.errors import UsageError

FORMATS = ("csv", "canvas", "moodle", "gradescope")


def add(commands: Commands) -> None:
    """Describe the command."""
    export = commands.add_parser("export", help="write grades for Canvas, Moodle, Gradescope, CSV")
    export.add_argument("--format", choices=FORMATS, required=True)
    export.add_argument(
        "--to",
        type=Path,
        metavar="PATH",
        help="the file (gradescope: the folder); default: FORMAT.csv or gradescope/ in --out",
    )
    add_out(export)
    add_class_list(export)
    export.set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Write the export, and name the work that belongs to nobody in the class list."""
    from autograder.gradebook import Gradebook, view_class
    from autograder.gradebook.student_names import names_of
    from autograder.reports import exports
    from autograder.reports.stale_marks import require_current
    from autograder.reports.terminal import warn

    course = load(parsed)
    with Gradebook(gradebook_path(parsed), create=False) as book:
        class_list = use_class_list(parsed, book)
        view = view_class(course, book, class_list)
        explanations = book.setting("explanations") == "yes"
    records = view.records
    if said := require_current(course, records):
        warn(said)
    names = names_of(records)
    waiting = [f"{names[record.student]} ({', '.join(record.open)})" for record in view.open]
    if waiting:
        warn(
            f"{len(waiting)} students have questions that wait for a person, and no grade yet: "
            f"{_some(waiting)}. See `autograder mark`."
        )
    if parsed.format == "gradescope":
        from autograder.release.gradescope.package import write_gradescope

        folder = parsed.to or parsed.out / "gradescope"
        count = write_gradescope(folder, course, records, explanations)
        console.print(
            f"{folder}: autograder.zip to upload, and results.json of {count} submissions.",
            markup=False,
            soft_wrap=True,
        )
        return DONE
    if parsed.format != "csv" and not class_list.students:
        raise UsageError(
            f"{parsed.format.capitalize()} needs names and numbers: write a class list "
            f"({parsed.out / 'class.toml'}) with a [[student]] table for each student."
        )
    path = parsed.to or parsed.out / f"{parsed.format}.csv"
    write = {
        "csv": exports.write_plain,
        "canvas": exports.write_canvas,
        "moodle": exports.write_moodle,
    }[parsed.format]
    left = write(path, course, class_list, records)
    if left and class_list.students:
        warn(
            f"{len(left)} submissions belong to nobody in the class list: "
            f"{_some([record.student for record in left])}. Nobody gets their points."
        )
        for record in left:
            match = view.matches[record.student]
            if match.line:
                warn(
                    f"{record.student}: {match.reason}. In students.toml beside the class list: "
                    f"{match.line}"
                )
    alike = exports.alike_for_canvas(class_list) if parsed.format == "canvas" else []
    if alike:
        warn(
            f"Canvas cannot tell {_some([person.text() for person in alike])} apart: the class "
            "list has no ID, SIS ID or login of theirs, so they are left out. Give the gradebook "
            "that Canvas exports as --class-list."
        )
    if view.missing:
        missing = [person.text() for person in view.missing]
        students = "student" if len(missing) == 1 else "students"
        warn(f"{len(missing)} {students} handed in nothing: {_some(missing)}.")
    console.print(f"{path} is written.", markup=False, soft_wrap=True)
    return DONE


def _some(names: list[str]) -> str:
    return ", ".join(names[:10]) + (", ..." if len(names) > 10 else "")
