"""``autograder adjust``: after the exam, see what a ``grading.toml`` changes, then accept it."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, TypedDict

from rich.console import Console

from autograder.cli.exit_status import DONE
from autograder.cli.shared_arguments import (
    Commands,
    add_author,
    add_class_list,
    add_json,
    add_out,
    gradebook_path,
    load,
    print_json,
    use_class_list,
)
from autograder.errors import UsageError

if TYPE_CHECKING:
    from autograder.gradebook import ClassView, Record

FILE = "grading.toml"


def add(commands: Commands) -> None:
    """Describe the command."""
    adjust = commands.add_parser(
        "adjust",
        help="drop, give or weigh questions after the exam; shows the differences first",
        description="Shows what grading.toml changes for each student; --accept keeps it. It may "
        "say dropped, given and bonus questions, [[excused]] students, [weights] of chapters, a "
        "[curve], and which [resubmission] counts.",
    )
    adjust.add_argument(
        "file", nargs="?", type=Path, metavar="FILE", help=f"default: {FILE} in --out"
    )
    adjust.add_argument("--accept", action="store_true", help="keep it, and write the reports")
    adjust.add_argument(
        "--withdraw", action="store_true", help="go back to the plain sum of the points"
    )
    add_author(adjust)
    add_out(adjust)
    add_class_list(adjust)
    add_json(adjust)
    adjust.set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Show each student's points before and after; keep the scheme if it is accepted."""
    from autograder.gradebook import Gradebook, view_class
    from autograder.gradebook.student_names import names_of
    from autograder.gradebook.view import SCHEME
    from autograder.reports.write import Options, write_reports

    course = load(parsed)
    path: Path = parsed.file or parsed.out / FILE
    proposed = "" if parsed.withdraw else _read(path)
    with Gradebook(gradebook_path(parsed), create=False) as book:
        class_list = use_class_list(parsed, book)
        before = view_class(course, book, class_list)
        after = view_class(course, book, class_list, proposed, str(path))
        rows = _differences(before, after)
        if parsed.accept:
            book.set(SCHEME, proposed)
            book.set(f"{SCHEME}_author", parsed.author)
            write_reports(course, book, Options(parsed.out, None, class_list))
    if parsed.json:
        most = {"before": before.scheme.most, "after": after.scheme.most}
        print_json({"accepted": parsed.accept, "max": most, "students": rows})
        return DONE
    _tell(console, before, after, rows, names_of(after.records))
    if parsed.accept:
        kept = "It is accepted; the reports are written again."
    elif parsed.withdraw:
        kept = "Nothing was changed; --withdraw --accept goes back to this."
    else:
        kept = "Nothing was changed; --accept keeps it."
    console.print(kept)
    return DONE


def _read(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise UsageError(
            f'There is no {path}; write one, such as dropped = ["Q1.2"], or name another file.'
        ) from None
    except (OSError, UnicodeDecodeError) as error:
        raise UsageError(f"{path} cannot be read: {error}.") from None


class _Row(TypedDict):
    """A student before and after."""

    student: str
    name: str
    before: float
    after: float
    share_before: float
    share_after: float
    questions: list[str]
    not_yet_marked: list[str]


def _differences(before: ClassView, after: ClassView) -> list[_Row]:
    """Each student's points and share before and after, by name."""
    old = {record.student: record for record in before.records}
    rows: list[_Row] = []
    for record in after.records:
        was = old[record.student]
        changed = [
            question
            for question in after.course.questions
            if was.points(question) != record.points(question)
        ]
        rows.append(
            {
                "student": record.student,
                "name": record.name,
                "before": was.total,
                "after": record.total,
                "share_before": _share(was, before.scheme.most),
                "share_after": _share(record, after.scheme.most),
                "questions": changed,
                "not_yet_marked": list(record.open),
            }
        )
    return sorted(rows, key=lambda row: (row["name"].casefold(), row["student"]))


def _share(record: Record, most: float) -> float:
    return round(record.total / most, 4) if most else 0.0


def _tell(
    console: Console,
    before: ClassView,
    after: ClassView,
    rows: list[_Row],
    names: Mapping[str, str],
) -> None:
    from autograder.reports.terminal import printable

    most, most_after = before.scheme.most, after.scheme.most
    differing = 0
    for row in rows:
        same = (row["before"], row["share_before"]) == (row["after"], row["share_after"])
        if same and not row["questions"]:
            continue
        differing += 1
        questions = f"  ({', '.join(row['questions'])})" if row["questions"] else ""
        name = names[row["student"]]
        console.print(
            printable(
                f"{name}: {row['before']:g} of {most:g} ({row['share_before']:.0%}) → "
                f"{row['after']:g} of {most_after:g} ({row['share_after']:.0%}){questions}"
            ),
            markup=False,
            soft_wrap=True,
        )
    if rows:
        lower = sum(row["share_after"] < row["share_before"] for row in rows)
        mean = sum(row["share_before"] for row in rows) / len(rows)
        mean_after = sum(row["share_after"] for row in rows) / len(rows)
        console.print(
            f"{differing} of {len(rows)} students see a difference, {lower} of them a smaller "
            f"share; the mean goes from {mean:.1%} to {mean_after:.1%}.",
            soft_wrap=True,
        )
