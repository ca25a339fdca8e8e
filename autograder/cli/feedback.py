"""``autograder feedback``: bring the pages of feedback back to the students."""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console

from autograder.cli.exit_status import BROKEN, DONE
from autograder.cli.shared_arguments import (
    Commands,
    add_class_list,
    add_out,
    gradebook_path,
    load,
    use_class_list,
)
from autograder.errors import UsageError

if TYPE_CHECKING:
    from autograder.course import Course
    from autograder.gradebook import ClassView
    from autograder.reports.returning import Left, Page, Parcel

SYSTEMS = ("moodle", "canvas", "email", "folder")


def add(commands: Commands) -> None:
    """Describe the command."""
    feedback = commands.add_parser(
        "feedback", help="pack the feedback for Moodle, Canvas, e-mail or folders"
    )
    feedback.add_argument(
        "--for", dest="system", choices=SYSTEMS, required=True, help="where the feedback goes"
    )
    feedback.add_argument(
        "--to",
        type=Path,
        metavar="PATH",
        help="the zip (email, folder: the folder); default: feedback_for_SYSTEM in --out",
    )
    feedback.add_argument(
        "--student", action="append", metavar="STUDENT", help="only this one (repeatable)"
    )
    mail = feedback.add_argument_group("sending e-mail (instead of writing .eml files)")
    mail.add_argument("--smtp", metavar="HOST[:PORT]", help="send by this mail server")
    mail.add_argument("--from", dest="sender", default="", metavar="ADDRESS", help="the sender")
    mail.add_argument(
        "--smtp-user",
        default="",
        metavar="NAME",
        help="log in (the password comes from the environment: AUTOGRADER_SMTP_PASSWORD)",
    )
    mail.add_argument("--smtp-security", choices=("starttls", "tls", "none"), default="starttls")
    mail.add_argument(
        "--dry-run", action="store_true", help="say who would get what, but write and send nothing"
    )
    add_out(feedback)
    add_class_list(feedback)
    feedback.set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Pack the pages; exit 1 if some go to nobody."""
    from autograder.gradebook import Gradebook, find_record, view_class
    from autograder.reports import returning
    from autograder.reports.feedback_html import feedback_html
    from autograder.reports.stale_marks import require_current
    from autograder.reports.terminal import warn
    from autograder.reports.write import feedback_of

    if parsed.smtp and parsed.system != "email":
        raise UsageError("--smtp sends e-mail; write --for email with it.")
    if parsed.smtp and not parsed.sender:
        raise UsageError("--smtp needs a sender: --from you@example.org.")
    course = load(parsed)
    with Gradebook(gradebook_path(parsed), create=False) as book:
        view = view_class(course, book, use_class_list(parsed, book))
        shared = feedback_of(view, book)
    said_ones = parsed.student or ()
    chosen = [find_record(view.records, one, view.missing) for one in said_ones] or view.records
    if said := require_current(course, chosen):
        warn(said)
    pages = [returning.Page(record, feedback_html(shared, record)) for record in chosen]
    if parsed.system == "email":
        return _mail(parsed, console, course, view, pages)
    # Where there is a class list, what is nobody's goes to nobody.
    certain = [page for page in pages if page.record.people or not view.class_list.students]
    nobodys = [
        returning.Left(page.record, view.matches[page.record.student].reason)
        for page in pages
        if page not in certain
    ]
    make = {
        "moodle": returning.moodle_files,
        "canvas": returning.canvas_files,
        "folder": returning.plain_files,
    }[parsed.system]
    parcel = make(certain)
    parcel = returning.Parcel(parcel.files, [*nobodys, *parcel.left])
    return _write(parsed, console, parcel, is_zip=parsed.system != "folder")


def _mail(
    parsed: argparse.Namespace,
    console: Console,
    course: Course,
    view: ClassView,
    pages: Sequence[Page],
) -> int:
    from autograder.reports.returning import mail

    title = view.class_list.title
    letters, left = mail.messages(course, pages, title, parsed.sender)
    if not parsed.smtp:
        return _write(parsed, console, mail.as_parcel(letters, left), is_zip=False)
    host, _, port = parsed.smtp.partition(":")
    default = "465" if parsed.smtp_security == "tls" else "587"
    if not (port or default).isdigit():
        raise UsageError(f"{parsed.smtp!r} is not a mail server; write HOST or HOST:PORT.")
    if parsed.dry_run:
        for letter in letters:
            _say(console, f"to {letter.message['To']}: {letter.message['Subject']}")
        _say(console, f"{len(letters)} messages would be sent by {parsed.smtp}; none was.")
    else:
        password = os.environ.get("AUTOGRADER_SMTP_PASSWORD", "")
        sent = mail.send(
            *(letters, host, int(port or default)),
            *(parsed.smtp_user, password, parsed.smtp_security),
        )
        count = 0
        for letter in sent:
            count += 1
            _say(console, f"sent to {letter.message['To']}")
        _say(console, f"{count} messages were sent.")
    return _tell_left(left)


def _write(parsed: argparse.Namespace, console: Console, parcel: Parcel, is_zip: bool) -> int:
    name = f"feedback_for_{parsed.system}" + (".zip" if is_zip else "")
    path: Path = parsed.to or parsed.out / name
    count = len(parcel.files)
    if parsed.dry_run:
        for file in parcel.files:
            _say(console, file)
        _say(console, f"{path} would hold {count} files; nothing was written.")
        return _tell_left(parcel.left)
    if is_zip:
        parcel.write_zip(path)
    else:
        parcel.write_folder(path)
    _say(console, f"{path} holds the feedback of {count} students.")
    return _tell_left(parcel.left)


def _tell_left(left: Sequence[Left]) -> int:
    from autograder.reports.terminal import warn

    alike: dict[str, list[str]] = {}
    for entry in left:
        alike.setdefault(entry.reason, []).append(entry.record.student)
    for reason, students in alike.items():
        whose = students[0]
        if len(students) > 1:  # a whole class may lack the same
            whose = f"{len(students)} students ({', '.join(students)})"
        warn(f"The feedback of {whose} goes to nobody: {reason}.")
    return BROKEN if left else DONE


def _say(console: Console, sentence: str) -> None:
    from autograder.reports.terminal import printable

    console.print(printable(sentence), markup=False, soft_wrap=True)
