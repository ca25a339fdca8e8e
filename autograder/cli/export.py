"""``autograder export``: grades for the systems that instructors use."""

from __future__ import annotations

import argparse
from pathlib import Path

from rich.console import Console

from autograder.cli.common import (
    Commands,
    add_class_list,
    add_out,
    find_class_list,
    gradebook_path,
    load,
)
from autograder.cli.status import DONE
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
    from autograder.gradebook import Gradebook
    from autograder.reports import exports
    from autograder.reports.terminal import warn

    course = load(parsed)
    with Gradebook(gradebook_path(parsed), create=False) as book:
        records = book.records()
        class_list = find_class_list(parsed, book)
        explanations = book.setting("explanations") == "yes"
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
        names = ", ".join(record.student for record in left[:10])
        warn(
            f"{len(left)} submissions belong to nobody in the class list: {names}"
            + (", ..." if len(left) > 10 else "")
            + ". Give their students a `submission` there."
        )
    missing = [student for student, record in exports.match(class_list, records)[0] if not record]
    if missing:
        names = ", ".join(student.name for student in missing[:10])
        warn(
            f"{len(missing)} students handed in nothing: {names}"
            + (", ..." if len(missing) > 10 else ".")
        )
    console.print(f"{path} is written.", markup=False, soft_wrap=True)
    return DONE
