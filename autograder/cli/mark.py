"""``autograder mark``: go through what waits for a person, here or on a page of one's own."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import TYPE_CHECKING

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
    from autograder.gradebook import Gradebook
    from autograder.gradebook.by_hand import Item


def add(commands: Commands) -> None:
    """Describe the command."""
    mark = commands.add_parser(
        "mark", help="mark by hand what waits for a person, question by question"
    )
    mark.add_argument("--question", metavar="ID", help="only this one")
    mark.add_argument("--anonymous", action="store_true", help="show no names")
    mark.add_argument("--list", action="store_true", help="only say what waits")
    mark.add_argument("--page", action="store_true", help="mark in a browser on this machine")
    mark.add_argument("--port", type=int, default=0, metavar="N", help="for --page (default: any)")
    add_author(mark)
    add_out(mark)
    add_class_list(mark)
    add_json(mark)
    mark.set_defaults(run=run)


def run(parsed: argparse.Namespace, console: Console) -> int:
    """Ask for a verdict on each open response and keep it at once; the reports come at the end."""
    from autograder.gradebook import Gradebook, view_class
    from autograder.gradebook.by_hand import open_items
    from autograder.reports.write import Options, write_reports

    course = load(parsed)
    question = course.question(parsed.question).id if parsed.question else None
    with Gradebook(gradebook_path(parsed), create=False) as book:
        class_list = use_class_list(parsed, book)
        items = open_items(view_class(course, book, class_list), question)
        if parsed.list or parsed.json:
            return _list(parsed, console, items)
        if not items:
            console.print("Nothing waits to be marked by hand.")
            return DONE
        marked: set[str] = set()
        try:
            if parsed.page:
                from autograder.cli.mark_page import serve

                def look() -> list[Item]:
                    return open_items(view_class(course, book, class_list), question)

                serve(parsed, console, book, look, marked)
            else:
                _ask_all(parsed, console, book, items, marked)
        finally:
            if marked:
                write_reports(course, book, Options(parsed.out, marked, class_list))
        left = len(open_items(view_class(course, book, class_list), question))
    console.print(f"{left} still wait." if left else "Everything is marked.")
    return DONE


def _list(parsed: argparse.Namespace, console: Console, items: list[Item]) -> int:
    if parsed.json:
        print_json(
            [{"question": i.question.id, "student": i.record.student, "why": i.why} for i in items]
        )
        return DONE
    for item in items:
        who = "" if parsed.anonymous else f" {item.called}"
        _say(console, f"{item.question.id}{who}: {item.why}")
    _say(console, f"{len(items)} wait to be marked by hand.")
    return DONE


def _ask_all(
    parsed: argparse.Namespace,
    console: Console,
    book: Gradebook,
    items: list[Item],
    marked: set[str],
) -> None:
    before = ""
    for count, item in enumerate(items, 1):
        if item.question.id != before:
            before = item.question.id
            _say(console, f"\n=== {item.question.id} · {item.question.title}")
            _say(console, item.question.prompt)
        who = "" if parsed.anonymous else f" · {item.called}"
        _say(console, f"\n--- {count} of {len(items)}{who}  ({item.why})")
        _say(console, item.response or "(nothing can be shown)")
        try:
            if not _ask(console, book, item, parsed.author, _read):
                continue
        except EOFError:
            _say(console, "")
            return
        marked.add(item.record.student)


def _ask(
    console: Console, book: Gradebook, item: Item, author: str, read: Callable[[str], str]
) -> bool:
    """Ask for one verdict; False if it was passed over."""
    from autograder.cli.override import read_points
    from autograder.gradebook.by_hand import give

    while True:
        levels: dict[str, str] = {}
        points = None
        for criterion in item.rubric:
            _say(console, f"{criterion.name}:")
            for number, level in enumerate(criterion.levels, 1):
                _say(console, f"  {number}  {level.name} ({level.points:g})")
            said = read("  level (Enter: later, q: stop): ")
            if not said:
                return False
            if not (said.isdecimal() and 1 <= int(said) <= len(criterion.levels)):
                _say(console, f"  {said!r} is none of them.")
                break
            levels[criterion.name] = criterion.levels[int(said) - 1].name
        else:
            if not item.rubric:
                said = read(f"points of {item.question.points:g} (Enter: later, q: stop): ")
                if not said:
                    return False
                try:
                    points = read_points(said)
                except UsageError as error:
                    _say(console, str(error))
                    continue
            comment = read("comment (for the student, may be empty): ")
            try:
                given = give(book, item, levels, points, comment, author)
            except UsageError as error:
                _say(console, str(error))
                continue
            _say(console, f"{given:g} of {item.question.points:g} points.")
            return True


def _read(prompt: str) -> str:
    said = input(prompt).strip()
    if said == "q":
        raise EOFError
    return said


def _say(console: Console, text: str) -> None:
    from autograder.reports.terminal import printable

    for line in text.split("\n"):
        console.print(printable(line), markup=False, soft_wrap=True)
